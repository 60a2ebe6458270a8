// Asks the service: one way in for every request of the page, with its token, its problems and its absence.

import {askToken} from './token.js';

/** The service said no: a problem of RFC 9457. */
export class Refused extends Error {
  constructor(problem, status, after) {
    super(problem.detail ?? problem.title ?? `status ${status}`);
    Object.assign(this, {problem, status, after, faults: problem.errors ?? []});
  }
}

/** The service said nothing. */
export class Unreachable extends Error {
  constructor() {
    super('The service does not answer.');
  }
}

let token = sessionStorage.getItem('voussoir.token') ?? localStorage.getItem('voussoir.token');

export const hasToken = () => token !== null;

/** Takes a token; kept on this device only where that is wished. */
export function useToken(given, keep) {
  forgetToken();
  token = given;
  (keep ? localStorage : sessionStorage).setItem('voussoir.token', given);
  document.dispatchEvent(new Event('voussoir:token'));
}

export function forgetToken() {
  token = null;
  sessionStorage.removeItem('voussoir.token');
  localStorage.removeItem('voussoir.token');
  document.dispatchEvent(new Event('voussoir:token'));
}

let away = null;

// Tells the page that the service is away, and once when it is back.
function isAway() {
  if (away) return;
  document.dispatchEvent(new Event('voussoir:away'));
  away = setInterval(async () => {
    const answer = await fetch('/health/live').catch(() => null);
    if (!answer?.ok) return;
    clearInterval(away);
    away = null;
    document.dispatchEvent(new Event('voussoir:back'));
  }, 1000);
}

/** The answer to a request. Throws `Refused` or `Unreachable`; asks for a token where one is needed. */
export async function call(method, path, {body, headers = {}, signal} = {}) {
  const head = {...headers},
    sent = token;
  if (body !== undefined) head['content-type'] = 'application/json';
  if (token) head.authorization = `Bearer ${token}`;
  const answer = await fetch(path, {method, headers: head, body, signal}).catch(error => {
    if (error.name === 'AbortError') throw error;
    isAway();
    throw new Unreachable();
  });
  if (answer.ok) return answer;
  const problem = await answer.json().catch(() => ({title: `The service answered with status ${answer.status}.`}));
  if (answer.status === 401) {
    // Somebody may have given another one while this was on its way.
    if (token === sent) await askToken(token ? 'The service does not know this token.' : '');
    return call(method, path, {body, headers, signal});
  }
  throw new Refused(problem, answer.status, answer.headers.get('retry-after'));
}

export const get = async (path, options) => (await call('GET', path, options)).json();

/** The path itself or, where there is a token, a link that opens it without one. */
export async function opened(path) {
  if (!token) return path;
  const answer = await call('POST', '/v1/links', {body: JSON.stringify({path, life_s: 3600})});
  return (await answer.json()).url;
}

/** Submits a request (its text): the status of the job. */
export async function submit(text) {
  return (await call('POST', '/v1/jobs', {body: text})).json();
}

/** The faults of a request (its text); none where it is one. */
export async function faultsOf(text, signal) {
  try {
    await call('POST', '/v1/validate', {body: text, signal});
    return [];
  } catch (error) {
    if (!(error instanceof Refused) || ![400, 413, 422].includes(error.status)) throw error;
    return error.faults.length > 0 ? error.faults : [{pointer: '', detail: error.message}];
  }
}
