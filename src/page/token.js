// Asks for the token of the service, once, whoever needs it.

import {button, el} from './dom.js';
import {forgetToken, hasToken, useToken} from './api.js';

let asking = null;

/** Settles when a token has been given. */
export function askToken(why) {
  asking ??= new Promise(resolve => show(why, resolve)).finally(() => {
    asking = null;
  });
  return asking;
}

function show(why, done) {
  const field = el('input', {
    type: 'password',
    id: 'token-field',
    autocomplete: 'off',
    required: true,
    spellcheck: 'false',
  });
  const keep = el('input', {type: 'checkbox', id: 'token-keep'});
  const form = el(
    'form',
    {method: 'dialog'},
    el('h2', {id: 'token-title'}, 'This service asks for a token'),
    el(
      'p',
      {role: why ? 'alert' : null, class: why ? 'fault' : 'soft'},
      why || 'Whoever runs the service gives tokens. It is sent with every request to this service and nowhere else.',
    ),
    el('p', {class: 'field'}, el('label', {for: 'token-field'}, 'Token'), field),
    el('p', {}, el('label', {class: 'check'}, keep, ' Keep it on this device when the tab is closed')),
    el('p', {class: 'row'}, el('button', {class: 'main'}, 'Use this token')),
  );
  const dialog = el('dialog', {'aria-labelledby': 'token-title'}, form);
  // Nothing works without it, so the dialog comes back until there is one.
  dialog.addEventListener('cancel', event => event.preventDefault());
  form.addEventListener('submit', () => {
    dialog.remove();
    useToken(field.value.trim(), keep.checked);
    done();
  });
  document.body.append(dialog);
  dialog.showModal();
}

/** A button that forgets the token; nothing where there is none. */
export function tokenButton(place) {
  const refresh = () => place.replaceChildren(...(hasToken() ? [button('Forget token', forget)] : []));
  const forget = () => {
    forgetToken();
    location.reload();
  };
  document.addEventListener('voussoir:token', refresh);
  refresh();
}
