// Numbers, forces, times and the service's words for people.

/** So many significant figures, with a true minus; what is no number is a dash. */
export function figures(x, count = 4) {
  if (typeof x !== 'number' || !Number.isFinite(x)) return '–';
  if (x === 0) return '0';
  const size = Math.abs(x);
  const text = size >= 1e7 || size < 1e-4 ? exponent(x, count) : String(Number(x.toPrecision(count)));
  return text.replaceAll('-', '−');
}

function exponent(x, count) {
  const [digits, power] = x.toExponential(count - 1).split('e');
  return `${Number(digits)}e${Number(power)}`;
}

/** N/m as kN/m. */
export const kilo = x => figures(x / 1e3);

/** Pa as MPa. */
export const mega = x => figures(x / 1e6);

export function seconds(s) {
  if (s === null || s === undefined) return '';
  if (s < 1) return `${Math.max(1, Math.round(s * 1e3))} ms`;
  return s < 120 ? `${figures(s, 3)} s` : `${Math.floor(s / 60)} min ${Math.round(s % 60)} s`;
}

/** A moment of the service as the reader's clock has it. */
export function moment(text) {
  const date = new Date(text);
  const today = date.toDateString() === new Date().toDateString();
  const clock = date.toLocaleTimeString([], {hour: '2-digit', minute: '2-digit', second: '2-digit'});
  return today ? clock : `${date.toLocaleDateString()} ${clock}`;
}

const WORDS = {
  accepted: 'waiting',
  running: 'running',
  successful: 'done',
  failed: 'failed',
  dismissed: 'cancelled',
  lost: 'lost',
};

/** A status in one word. */
export const statusWord = status => WORDS[status] ?? status;

/** `crown_rises` as words. */
export const words = name => String(name).replaceAll('_', ' ');
