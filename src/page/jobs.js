// All jobs, newest first, as they go; and where a new one begins.

import {Refused, Unreachable, get} from './api.js';
import {active, actions, badge, progressBar, progressWords, showProgress} from './status.js';
import {button, el, put} from './dom.js';
import {follow} from './stream.js';
import {moment} from './number.js';
import {remembered} from './memory.js';
import {STARTERS} from './starters.js';

const PAGE = 100;
const AGAIN = 5000;

export function jobsView(go, take) {
  const list = el('ol', {class: 'jobs', 'aria-label': 'Jobs, newest first'});
  const count = el('p', {class: 'soft', role: 'status'}, 'Asking for the jobs …');
  const more = button('Show older jobs', () => older(view), {hidden: true});
  const view = {list, count, more, go, rows: new Map(), next: null, older: [], stop: () => {}};
  const refresh = () => first(view);
  // A service that was away may have lost any job.
  const anew = () => {
    view.older = [];
    first(view);
  };
  const timer = setInterval(() => {
    if (!document.hidden) refresh();
  }, AGAIN);
  document.addEventListener('voussoir:back', anew);
  document.addEventListener('voussoir:token', refresh);
  refresh();
  const stop = () => {
    view.over = true;
    clearInterval(timer);
    view.stop();
    document.removeEventListener('voussoir:back', anew);
    document.removeEventListener('voussoir:token', refresh);
  };
  return {
    node: el(
      'div',
      {},
      beginnings(take),
      el(
        'section',
        {'aria-labelledby': 'jobs-title'},
        el('h2', {id: 'jobs-title'}, 'Jobs'),
        count,
        list,
        el('p', {}, more),
      ),
    ),
    stop,
  };
}

function beginnings(take) {
  const file = el('input', {
    type: 'file',
    id: 'file',
    accept: '.csv,.json,text/csv,application/json',
    onchange: () => {
      if (file.files.length > 0) take(file.files[0]);
      file.value = '';
    },
  });
  return el(
    'section',
    {class: 'starters', 'aria-labelledby': 'new-title'},
    el('h2', {id: 'new-title'}, 'When does it fall, how, and how sure is that?'),
    el(
      'ul',
      {},
      Object.entries(STARTERS).map(([kind, {words, about}]) =>
        el('li', {}, el('a', {href: `#/new/${kind}`}, el('strong', {}, words), el('span', {class: 'soft'}, about))),
      ),
      el(
        'li',
        {class: 'file'},
        el(
          'label',
          {for: 'file'},
          el('strong', {}, 'From a file'),
          el(
            'span',
            {class: 'soft'},
            'A request (JSON), or points surveyed on an arch (CSV: side, x_m, y_m). Drop it anywhere on the page, or choose it:',
          ),
        ),
        file,
      ),
    ),
  );
}

/** The newest jobs, and those shown before that are not among them. */
async function first(view) {
  try {
    const answer = await get(`/v1/jobs?limit=${PAGE}`);
    if (view.older.length === 0) view.next = answer.links.next ?? null;
    const ids = new Set(answer.jobs.map(job => job.job_id));
    view.older = view.older.filter(job => !ids.has(job.job_id));
    const oldest = answer.links.next ? answer.jobs.at(-1).created : '';
    show(view, answer.jobs, [...(await missing(view, ids, oldest)), ...view.older]);
  } catch (error) {
    if (!(error instanceof Unreachable)) view.count.textContent = error.message;
  }
}

/** Jobs that this page has seen or sent, and that should be listed but are not: each is asked for by name. */
async function missing(view, ids, oldest) {
  const older = new Set(view.older.map(job => job.job_id));
  const known = new Map(
    remembered().map(entry => [entry.id, {job_id: entry.id, name: entry.name, created: entry.created}]),
  );
  for (const [id, row] of view.rows) known.set(id, row.job);
  const absent = [...known.values()].filter(
    job => !ids.has(job.job_id) && !older.has(job.job_id) && job.created > oldest,
  );
  const found = await Promise.all(
    absent.map(async job => {
      if (job.status === 'lost') return job;
      try {
        return await get(`/v1/jobs/${job.job_id}`);
      } catch (error) {
        return error instanceof Refused && error.status === 404 ? {...job, status: 'lost'} : job;
      }
    }),
  );
  return found.filter(job => job.status);
}

function show(view, jobs, rest) {
  if (view.over) return;
  const all = [...jobs, ...rest].sort((a, b) => b.created.localeCompare(a.created));
  const rows = new Map();
  for (const job of all) {
    const row = view.rows.get(job.job_id) ?? newRow(view, job);
    update(view, row, job);
    rows.set(job.job_id, row);
  }
  view.rows = rows;
  arrange(
    view.list,
    [...rows.values()].map(row => row.node),
  );
  view.count.textContent =
    rows.size === 0
      ? 'No jobs yet. Begin with one of the structures above.'
      : `${rows.size}${view.next ? ' newest' : ''} ${rows.size === 1 ? 'job' : 'jobs'}`;
  view.more.hidden = view.next === null;
  followActive(view);
}

/** Only what is new or has gone moves, so that whoever is in a row stays in it. */
function arrange(list, nodes) {
  const wanted = new Set(nodes);
  for (const node of [...list.children]) if (!wanted.has(node)) node.remove();
  let place = list.firstElementChild;
  for (const node of nodes) {
    if (node === place) place = place.nextElementSibling;
    else list.insertBefore(node, place);
  }
}

function newRow(view, job) {
  const name = job.name ?? 'Without a name';
  const row = {
    badge: el('span'),
    words: el('span', {class: 'words soft'}),
    bar: progressBar(name),
    buttons: el('span', {class: 'buttons'}),
  };
  row.node = el(
    'li',
    {class: 'job', 'data-id': job.job_id},
    el('a', {class: 'name', href: `#/jobs/${job.job_id}`}, name),
    row.badge,
    el('span', {class: 'soft time'}, moment(job.created)),
    el('span', {class: 'progress'}, row.bar, row.words),
    row.buttons,
  );
  return row;
}

function update(view, row, job) {
  const same = row.job?.status === job.status;
  row.job = job;
  row.words.textContent = progressWords(job);
  showProgress(row.bar, job);
  if (same) return;
  put(row.badge, badge(job));
  put(
    row.buttons,
    actions(job.job_id, job, {
      go: view.go,
      after: (error, now) => {
        if (now === null) drop(view, job.job_id);
        else if (now) update(view, row, now);
        else first(view);
      },
    }),
  );
}

function drop(view, id) {
  view.rows.get(id)?.node.remove();
  view.rows.delete(id);
  view.older = view.older.filter(job => job.job_id !== id);
  first(view);
}

function followActive(view) {
  const ids = [...view.rows.values()].filter(row => active(row.job)).map(row => row.job.job_id);
  const key = ids.join();
  if (key === view.followed) return;
  view.followed = key;
  view.stop();
  view.stop = follow(ids, (id, job) => {
    const row = view.rows.get(id);
    if (row) update(view, row, {...row.job, ...job});
  });
}

async function older(view) {
  view.more.disabled = true;
  const answer = await get(view.next.replace(/limit=\d+/, 'limit=1000')).catch(error => ({error}));
  view.more.disabled = false;
  if (answer.error) return void (view.count.textContent = answer.error.message);
  view.next = answer.links.next ?? null;
  const listed = [...view.rows.values()].map(row => row.job);
  const known = new Set(listed.map(job => job.job_id));
  const more = answer.jobs.filter(job => !known.has(job.job_id));
  view.older = [...view.older, ...more];
  show(view, listed, more);
  [...view.list.children][listed.length]?.querySelector('a').focus();
}
