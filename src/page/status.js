// How a job stands, in words and as a bar; and what can be done with it.

import {Refused, call, submit} from './api.js';
import {button, complain, el, say} from './dom.js';
import {figures, seconds, statusWord} from './number.js';
import {forget, remember, requestOf} from './memory.js';

export const active = ({status}) => status === 'accepted' || status === 'running';

/** One word, never by its colour alone. */
export const badge = ({status}) => el('span', {class: `badge ${status}`}, statusWord(status));

/** What there is to say of the progress of a job. */
export function progressWords({status, progress, queue_position: place, wall_time_s: time, problem}) {
  if (status === 'accepted') return place ? `place ${place} in the queue` : 'in the queue';
  if (status === 'running' && !progress) return `begun${time ? `, ${seconds(time)}` : ''}`;
  if (status === 'running')
    return [
      typeof progress.percent === 'number' && `${figures(progress.percent, 3)} %`,
      progress.events > 0 && `load factor ${figures(progress.load_factor)}, ${progress.events} events`,
      seconds(time),
    ]
      .filter(Boolean)
      .join(', ');
  if (status === 'failed') return problem?.detail ?? 'no answer';
  if (status === 'lost') return 'The service no longer has this job: it was started anew, or it forgot the job.';
  return status === 'successful' ? seconds(time) : '';
}

/** Keeps a bar in step with the job. */
export function showProgress(bar, {status, progress}) {
  const percent = progress?.percent;
  bar.hidden = status !== 'running' && status !== 'accepted';
  if (typeof percent === 'number') bar.value = percent / 100;
  else bar.removeAttribute('value');
}

export const progressBar = name => el('progress', {max: 1, 'aria-label': `Progress of ${name}`});

/** Buttons for a job: cancel, clone, edit a copy, forget. `after` runs when something has changed. */
export function actions(id, job, {go, after}) {
  const lost = job.status === 'lost',
    kept = requestOf(id);
  const name = job.name ?? 'the job';
  const act = work => async event => {
    event.target.disabled = true;
    try {
      await work();
    } catch (error) {
      // Whoever cancels a job that has just ended is told so by its new status.
      if (!(error instanceof Refused && error.status === 409)) complain(error.message);
      after?.(error);
    } finally {
      event.target.disabled = false;
    }
  };
  const label = words => ({class: 'small', 'aria-label': `${words} ${name}`});
  return [
    active(job) &&
      button(
        'Cancel',
        act(async () => after?.(null, await (await call('DELETE', `/v1/jobs/${id}`)).json())),
        label('Cancel'),
      ),
    (!lost || kept) &&
      button(
        'Clone',
        act(() => clone(id, go)),
        label('Clone'),
      ),
    (!lost || kept) && button('Edit a copy', () => go(`#/new/job/${id}`), label('Edit a copy of')),
    !active(job) &&
      button(
        'Forget',
        act(async () => {
          if (!lost) await call('DELETE', `/v1/jobs/${id}/results`);
          forget(id);
          after?.(null, null);
        }),
        label('Forget'),
      ),
  ];
}

/** Submits the request of a job again. */
async function clone(id, go) {
  const body = requestOf(id) ?? (await (await call('GET', `/v1/jobs/${id}/request`)).text());
  const job = await submit(body);
  remember(job, body);
  say('Submitted again as a new job.');
  go(`#/jobs/${job.job_id}`);
}

export const problemOf = ({problem}) =>
  el(
    'div',
    {class: 'problem fault', role: 'alert'},
    el('h2', {}, problem.title),
    el('p', {}, problem.detail),
    problem.errors?.length > 0 &&
      el(
        'ul',
        {},
        problem.errors.map(({pointer, detail}) => el('li', {}, el('code', {}, pointer), ' ', detail)),
      ),
  );
