// The view of a new request: fields, the drawing and the JSON, three ways to see and change one draft.

import {Draft} from './draft.js';
import {Sketch} from './sketch.js';
import {Refused, submit} from './api.js';
import {answerFields, questionFields} from './question-form.js';
import {fillFields, loadFields} from './loads-form.js';
import {STARTERS} from './starters.js';
import {button, el, put, save, say} from './dom.js';
import {group, text} from './fields.js';
import {remember} from './memory.js';
import {show, toFirst} from './faults.js';
import {stoneFields} from './stone-form.js';
import {structureFields} from './structure-form.js';
import {written} from './pointer.js';

/** The whole view of a request; `go(path)` leads on to its job. */
export function formView(request, go) {
  const form = el('form', {id: 'request', novalidate: true, 'aria-label': 'Request'});
  const rest = el('ul', {class: 'fault list', 'aria-label': 'Faults of the request as a whole'});
  const json = el('textarea', {
    id: 'json',
    class: 'json',
    spellcheck: 'false',
    'aria-describedby': 'json-fault',
    'aria-label': 'Request as JSON',
  });
  const state = el('p', {class: 'state', role: 'status'}, 'Checking …');
  const draft = new Draft(request, {
    changed: () => changed(),
    reshaped: () => fill(form, draft),
    judged: (faults, error) => judged({form, rest, state}, faults, error),
  });
  const sketch = new Sketch(draft);
  const changed = () => {
    sketch.refresh();
    if (document.activeElement !== json) json.value = written(draft.request);
    state.setAttribute('aria-busy', 'true');
  };
  const run = el('button', {type: 'submit', form: 'request', class: 'main', id: 'analyse'}, 'Analyse');
  form.addEventListener('submit', event => {
    event.preventDefault();
    send(draft, {form, state, run}, go);
  });
  readJson(json, draft);
  fill(form, draft);
  draft.touch();
  const node = el(
    'div',
    {class: 'new'},
    el(
      'div',
      {class: 'side'},
      sketch.view.node,
      el('div', {class: 'row go'}, run, state),
      rest,
      el(
        'details',
        {class: 'pane', open: matchMedia('(min-width: 60rem)').matches},
        el('summary', {}, 'The request as JSON'),
        json,
        el('p', {class: 'fault', id: 'json-fault'}),
        el(
          'p',
          {class: 'row'},
          button('Save the request', () => save('request.json', new Blob([written(draft.request)]))),
        ),
      ),
    ),
    form,
  );
  const again = () => draft.touch();
  document.addEventListener('voussoir:back', again);
  return {
    node,
    request: () => draft.request,
    stop: () => {
      document.removeEventListener('voussoir:back', again);
      draft.stop();
    },
  };
}

/** Fills the form anew; whoever was in a field stays there. */
function fill(form, draft) {
  const focused = document.activeElement?.id;
  const open = new Set([...form.querySelectorAll('details[open]')].map(section => section.id));
  const section = (id, title, begins, ...fields) =>
    el(
      'details',
      {id, class: 'section', open: form.childElementCount ? open.has(id) : begins},
      el('summary', {}, el('h2', {}, title)),
      fields,
    );
  put(
    form,
    group('/name', 'What', text(draft, '/name', 'Name'), kinds(draft)),
    section('s-structure', kindOf(draft.request), true, structureFields(draft)),
    section('s-loads', 'Loads', true, loadFields(draft), fillFields(draft)),
    section('s-stone', 'Stone and joints', false, stoneFields(draft)),
    section('s-question', 'Question', false, questionFields(draft)),
    section('s-answer', 'What the answer shows', false, el('div', {class: 'grid'}, answerFields(draft))),
  );
  if (draft.faults) show(form, el('ul'), draft.faults);
  if (focused) document.getElementById(focused)?.focus();
}

const kindOf = request =>
  (Object.keys(STARTERS).find(kind => request[kind]) ?? 'structure').replace(/^./, letter => letter.toUpperCase());

function kinds(draft) {
  return el(
    'fieldset',
    {class: 'kinds'},
    el('legend', {class: 'unseen'}, 'Structure'),
    Object.entries(STARTERS).map(([kind, {words, request}]) =>
      el(
        'label',
        {class: 'kind'},
        el('input', {
          type: 'radio',
          name: 'kind',
          id: `kind-${kind}`,
          checked: Boolean(draft.request[kind]),
          onchange: () => draft.change(kind, structuredClone(request)),
        }),
        ` ${words}`,
      ),
    ),
  );
}

function judged({form, rest, state}, faults, error) {
  state.removeAttribute('aria-busy');
  if (faults === null) {
    state.textContent = `Not checked: ${error.message}`;
    return;
  }
  show(form, rest, faults);
  const count = faults.length;
  state.textContent =
    count === 0 ? 'The service understands this request.' : `${count} ${count === 1 ? 'fault' : 'faults'} to mend.`;
  state.classList.toggle('fault', count > 0);
}

function readJson(json, draft) {
  json.addEventListener('input', () => {
    const told = document.getElementById('json-fault');
    try {
      const request = JSON.parse(json.value);
      told.textContent = '';
      json.removeAttribute('aria-invalid');
      if (request === null || typeof request !== 'object' || Array.isArray(request))
        throw new Error('a request is an object in braces');
      draft.replace(request);
    } catch (error) {
      told.textContent = `This is no request: ${error.message}`;
      json.setAttribute('aria-invalid', 'true');
    }
  });
  json.addEventListener('blur', () => {
    if (!json.hasAttribute('aria-invalid')) json.value = written(draft.request);
  });
}

async function send(draft, {form, state, run}, go) {
  run.disabled = true;
  const faults = await draft.judge();
  try {
    if (faults?.length > 0) {
      toFirst(form);
      say(state.textContent);
    } else if (faults) {
      const body = JSON.stringify(draft.request);
      const job = await submit(body);
      remember(job, body);
      go(`#/jobs/${job.job_id}`);
    }
  } catch (error) {
    const after = error instanceof Refused && error.after ? ` Try again in ${error.after} s.` : '';
    state.textContent = `Not sent: ${error.message}${after}`;
    state.classList.add('fault');
  } finally {
    run.disabled = false;
  }
}
