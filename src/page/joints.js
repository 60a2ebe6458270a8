// The joints of an end as a table, and as tab-separated values for a spreadsheet.

import {button, el, put, say, table} from './dom.js';
import {figures, kilo} from './number.js';
import {happenings} from './thrust.js';

const FIRST = 300;
const HEADINGS = ['Joint', 'Between', 'Normal, kN/m', 'Shear, kN/m', 'Eccentricity, m', 'Length, m', 'What happens'];

/** Rows of raw values: joint, between, N/m, N/m, m, m, words. */
function rowsOf({joints}, end) {
  const line = end.thrust_line,
    at = new Map(line.joint.map((joint, i) => [joint, i]));
  const happens = new Map();
  for (const {joint, text} of happenings(end)) happens.set(joint, [...(happens.get(joint) ?? []), text]);
  return joints.map(({between, ends_m: [a, b]}, joint) => {
    const i = at.get(joint),
      of = column => (i === undefined ? null : column[i]);
    return [
      joint,
      between.join(' and '),
      of(line.normal_n_per_m),
      of(line.shear_n_per_m),
      of(line.eccentricity_m),
      Math.hypot(b[0] - a[0], b[1] - a[1]),
      (happens.get(joint) ?? []).join('; '),
    ];
  });
}

const shown = ([joint, between, normal, shear, off, length, what]) => [
  joint,
  between,
  kilo(normal),
  kilo(shear),
  figures(off),
  figures(length),
  what,
];

export function jointTable(structure, end) {
  if (!end?.thrust_line) return null;
  const rows = rowsOf(structure, end);
  const place = el('div', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Joints'});
  const show = count => put(place, table(HEADINGS, rows.slice(0, count).map(shown), 'Joints at collapse'));
  show(FIRST);
  const all =
    rows.length > FIRST &&
    button(
      `Show all ${rows.length} joints`,
      event => {
        show(rows.length);
        event.target.remove();
      },
      {class: 'small'},
    );
  const tell = el('span', {class: 'soft', role: 'status'});
  const names = ['joint', 'between', 'normal_n_per_m', 'shear_n_per_m', 'eccentricity_m', 'length_m', 'what'];
  const copyAll = button(
    'Copy the table',
    async () => {
      await copy([names, ...rows].map(row => row.map(cell => cell ?? '').join('\t')).join('\n'));
      tell.textContent = `${rows.length} rows copied, separated by tabs.`;
    },
    {class: 'small', id: 'copy-joints'},
  );
  return el(
    'section',
    {'aria-labelledby': 'joints-title'},
    el('h3', {id: 'joints-title'}, 'Joints at collapse'),
    el('p', {class: 'row'}, copyAll, all, tell),
    place,
  );
}

/** Browsers keep the clipboard from pages without TLS; there the text is copied from a field. */
async function copy(text) {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const field = el('textarea', {class: 'unseen', value: text, 'aria-hidden': 'true'});
  document.body.append(field);
  field.select();
  document.execCommand('copy');
  field.remove();
  say('Copied.');
}
