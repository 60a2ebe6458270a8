// Follows jobs as they go: one event stream for up to a hundred of them, and none while nobody looks: a browser has few connections
// for all its tabs.

import {Refused, get, opened} from './api.js';

const MOST = 100;
const FIRST_PAUSE = 500;
const LONGEST_PAUSE = 8000;

/**
 * Calls `told(id, status)` with whatever is new of these jobs until each has ended; a job that the service no longer has is told as
 * `{status: 'lost'}`. Returns what stops it.
 */
export function follow(ids, told) {
  const open = new Set(ids.slice(0, MOST));
  const last = new Map();
  let source = null,
    timer = null,
    stopped = false,
    pause = FIRST_PAUSE;

  const tell = (id, news) => {
    const status = {...last.get(id), ...news};
    last.set(id, status);
    if (!['accepted', 'running'].includes(status.status)) open.delete(id);
    if (!stopped) told(id, status);
  };
  const hear = event => {
    pause = FIRST_PAUSE;
    const {job_id: id, type, wall_time_s, ...news} = JSON.parse(event.data);
    // A step has the fields of the progress; a status has it as a field.
    const whole =
      event.type === 'step' ? {status: 'running', wall_time_s, progress: news} : {job_id: id, wall_time_s, ...news};
    tell(id, whole);
    if (open.size === 0) stop();
  };
  // A stream that broke off says nothing of why: every job is looked up, then the rest is followed again.
  const again = async () => {
    source?.close();
    if (document.hidden) return;
    for (const id of [...open]) {
      if (stopped) return;
      try {
        tell(id, await get(`/v1/jobs/${id}`));
      } catch (error) {
        if (error instanceof Refused && error.status === 404) tell(id, {status: 'lost'});
      }
    }
    if (stopped || open.size === 0) return;
    clearTimeout(timer);
    timer = setTimeout(connect, pause);
    pause = Math.min(2 * pause, LONGEST_PAUSE);
  };
  const connect = async () => {
    try {
      const url = await opened(`/v1/events?${[...open].map(id => `job=${id}`).join('&')}`);
      if (stopped) return;
      source?.close();
      source = new EventSource(url);
      for (const name of ['status', 'step', 'end']) source.addEventListener(name, hear);
      source.addEventListener('error', again);
    } catch {
      again();
    }
  };
  const looked = () => {
    clearTimeout(timer);
    again();
  };
  const stop = () => {
    stopped = true;
    source?.close();
    clearTimeout(timer);
    document.removeEventListener('visibilitychange', looked);
  };
  document.addEventListener('visibilitychange', looked);
  if (open.size > 0) connect();
  return stop;
}
