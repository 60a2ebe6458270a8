// One job: how it goes and, when it is done, its answer.

import {Refused, Unreachable, get} from './api.js';
import {Sketch} from './sketch.js';
import {active, actions, badge, problemOf, progressBar, progressWords, showProgress} from './status.js';
import {answerView} from './answer.js';
import {el, put, say} from './dom.js';
import {follow} from './stream.js';
import {moment, statusWord} from './number.js';
import {outline} from './outline.js';
import {requestOf} from './memory.js';

export function jobView(id, go) {
  const head = {
    name: el('h2', {class: 'jobname'}, ' '),
    badge: el('span'),
    words: el('span', {class: 'soft', id: 'progress-words'}),
    bar: progressBar('this job'),
    buttons: el('span', {class: 'buttons'}),
  };
  const body = el('div', {class: 'body'});
  const view = {id, go, head, body, stop: () => {}, status: null};
  const node = el(
    'article',
    {class: 'onejob'},
    el(
      'header',
      {},
      head.name,
      el('p', {class: 'row'}, head.badge, head.words, head.buttons),
      el('p', {class: 'live'}, head.bar),
    ),
    body,
  );
  const back = () => load(view);
  document.addEventListener('voussoir:back', back);
  load(view);
  return {
    node,
    stop: () => {
      view.over = true;
      view.stop();
      document.removeEventListener('voussoir:back', back);
    },
  };
}

async function load(view) {
  view.stop();
  try {
    const job = await get(`/v1/jobs/${view.id}`);
    update(view, job);
    if (active(job) && !view.over) view.stop = follow([view.id], (_, news) => update(view, {...view.job, ...news}));
  } catch (error) {
    if (error instanceof Refused && error.status === 404) update(view, {...view.job, status: 'lost'});
    else if (!(error instanceof Unreachable)) put(view.body, el('p', {class: 'fault', role: 'alert'}, error.message));
  }
}

function update(view, job) {
  if (view.over) return;
  const {head} = view,
    changed = view.status !== job.status;
  view.job = job;
  view.status = job.status;
  head.words.textContent = `${progressWords(job)}${job.created ? ` · submitted ${moment(job.created)}` : ''}`;
  showProgress(head.bar, job);
  if (!changed) return;
  head.name.textContent = job.name ?? (job.status === 'lost' ? 'This job is not known' : 'Without a name');
  document.title = `${head.name.textContent} – Voussoir`;
  put(head.badge, badge(job));
  put(
    head.buttons,
    actions(view.id, job, {
      go: view.go,
      after: (error, now) => {
        if (now === null) view.go('#/');
        else if (now) update(view, now);
        else load(view);
      },
    }),
  );
  say(`The job is ${statusWord(job.status)}.`);
  ended(view, job);
}

/** What is analysed, until there is an answer. */
async function waits(view) {
  if (view.body.childElementCount > 0) return;
  put(view.body, el('p', {class: 'soft'}, 'The answer will be here when the job is done; this page follows it.'));
  const request = await get(`/v1/jobs/${view.id}/request`).catch(() => null);
  if (request && active(view.job) && outline(request))
    view.body.append(el('div', {class: 'waits'}, new Sketch({request}).view.node));
}

async function ended(view, job) {
  if (job.status === 'failed') put(view.body, problemOf(job));
  if (job.status === 'dismissed') put(view.body, el('p', {}, 'It was cancelled, and has no answer.'));
  if (job.status === 'lost')
    put(
      view.body,
      el(
        'p',
        {},
        requestOf(view.id)
          ? 'This browser sent it: Clone submits its request again.'
          : 'Its request is not kept in this browser either.',
      ),
    );
  if (active(job)) await waits(view);
  if (job.status !== 'successful') return;
  try {
    const node = await answerView(view.id);
    if (!view.over) put(view.body, node);
  } catch (error) {
    put(view.body, el('p', {class: 'fault', role: 'alert'}, `The answer cannot be shown: ${error.message}`));
  }
}
