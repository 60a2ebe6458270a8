// What this browser has submitted: the service may forget a job, or lose it with its process, and then it can be sent again.

const KEY = 'voussoir.submitted';
const MOST = 50;
const LONGEST = 50_000;

function read() {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? '[]');
  } catch {
    return [];
  }
}

function write(entries) {
  try {
    localStorage.setItem(KEY, JSON.stringify(entries.slice(0, MOST)));
  } catch {
    // A full or forbidden storage only means that nothing is remembered.
  }
}

export function remember(job, text) {
  if (text.length > LONGEST) return;
  write([{id: job.job_id, name: job.name, created: job.created, text}, ...read()]);
}

/** All that is remembered, newest first. */
export const remembered = read;

/** The request that was sent for this job; none where it is not remembered. */
export const requestOf = id => read().find(entry => entry.id === id)?.text;

export const forget = id => write(read().filter(entry => entry.id !== id));
