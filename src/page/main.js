// Starts the page: which view an address shows, files that are dropped, and the word that the service is away.

import {formView} from './form.js';
import {get} from './api.js';
import {jobView} from './job.js';
import {jobsView} from './jobs.js';
import {requestOf} from './memory.js';
import {requestFrom} from './survey.js';
import {STARTERS} from './starters.js';
import {tokenButton} from './token.js';
import {complain, el, put, say} from './dom.js';

const main = document.getElementById('main');
// Drafts by their addresses: whoever comes back to one finds it as it was left.
const drafts = new Map();
let shown = null,
  turn = 0,
  given = null;

/** Leads to an address, where everything begins anew. */
const go = path => {
  keepDraft();
  shown = {stop: shown?.stop};
  drafts.delete(path);
  if (location.hash === path) show();
  else location.hash = path;
};

function keepDraft() {
  if (shown?.request) drafts.set(shown.address, shown.request());
}

/** The view of an address: {title, node, stop}. */
async function viewOf(address) {
  const [kind, id] = address.replace(/^#?\/?/, '').split('/');
  if (kind === 'jobs' && id) return {title: 'Job', ...jobView(id, go)};
  if (kind === 'new') return {title: 'New analysis', ...formView(await requestFor(address), go)};
  return {title: 'Jobs', ...jobsView(go, take)};
}

/** The request that a new one begins with: a starter, a file, or that of a job. */
async function requestFor(address) {
  const [, , kind, id] = address.split('/');
  if (drafts.has(address)) return drafts.get(address);
  if (kind === 'file' && given) return structuredClone(given);
  if (kind === 'job') {
    const kept = requestOf(id);
    return kept ? JSON.parse(kept) : get(`/v1/jobs/${id}/request`);
  }
  return structuredClone((STARTERS[kind] ?? STARTERS.arch).request);
}

async function show() {
  const mine = ++turn,
    first = shown === null,
    address = location.hash;
  keepDraft();
  shown?.stop?.();
  shown = {};
  complain('');
  try {
    const view = await viewOf(address);
    if (mine !== turn) return view.stop?.();
    shown = {...view, address};
    document.title = `${view.title} – Voussoir`;
    put(main, el('h1', {class: 'unseen', id: 'title'}, view.title), view.node);
  } catch (error) {
    put(
      main,
      el('h1', {}, 'This cannot be shown'),
      el('p', {class: 'fault'}, error.message),
      el('p', {}, el('a', {href: '#/'}, 'All jobs')),
    );
  }
  if (!first) {
    scrollTo(0, 0);
    main.focus({preventScroll: true});
  }
  document.documentElement.dataset.ready = 'true';
  performance.mark('ready');
}

/** A file, dropped or chosen: the form of the request that it describes. */
async function take(file) {
  try {
    given = await requestFrom(file);
    go('#/new/file');
  } catch (error) {
    complain(error.message);
  }
}

function listenForFiles() {
  addEventListener('dragover', event => {
    if (!event.dataTransfer?.types.includes('Files')) return;
    event.preventDefault();
    document.body.classList.add('dropping');
  });
  addEventListener('dragleave', event => {
    if (!event.relatedTarget) document.body.classList.remove('dropping');
  });
  addEventListener('drop', event => {
    document.body.classList.remove('dropping');
    if (!event.dataTransfer?.files.length) return;
    event.preventDefault();
    take(event.dataTransfer.files[0]);
  });
}

function listenForTheService() {
  const word = document.getElementById('away'),
    text = word.textContent;
  document.addEventListener('voussoir:away', () => {
    put(word, text).hidden = false;
  });
  document.addEventListener('voussoir:back', () => {
    word.hidden = true;
    say('The service answers again.');
  });
}

document.getElementById('skip').addEventListener('click', event => {
  event.preventDefault();
  main.focus();
});
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  for (const view of document.querySelectorAll('.view')) view.dispatchEvent(new Event('recolour'));
});
document.addEventListener('click', event => {
  const link = event.target.closest('a[href^="#/new/"]');
  if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  go(link.hash);
});
addEventListener('hashchange', show);
tokenButton(document.getElementById('token'));
listenForFiles();
listenForTheService();
show();
