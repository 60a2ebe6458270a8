// What an answer can be taken away as: the service has every part of it in every format.

import {button, el, save} from './dom.js';
import {call} from './api.js';

export function exportsOf(id, answer) {
  const results = `/v1/jobs/${id}/results`;
  const files = [
    ['Answer', 'JSON', results, 'answer.json'],
    ['Answer', 'text', `${results}?f=text`, 'answer.txt'],
    answer.history?.load_factor.length > 0 && ['Load path', 'CSV', `${results}/history?f=csv`, 'history.csv'],
    (answer.ends?.length > 0 || answer.settlement) && ['Figure', 'SVG', `${results}/figure?f=svg`, 'figure.svg'],
    (answer.ends?.length > 0 || answer.settlement) && ['Figure', 'PNG', `${results}/figure?f=png`, 'figure.png'],
    !answer.subblocks && ['Report', 'PDF', `${results}/report?f=pdf`, 'report.pdf'],
    ...(answer.stress_fields ?? []).flatMap((field, i) => fieldFiles(answer, i, `${results}/fields`)),
    ['Request', 'JSON', `/v1/jobs/${id}/request`, 'request.json'],
  ].filter(Boolean);
  const told = el('p', {class: 'fault', role: 'status'});
  return el(
    'section',
    {'aria-labelledby': 'exports-title'},
    el('h3', {id: 'exports-title'}, 'Take it away'),
    el(
      'ul',
      {class: 'exports'},
      files.map(([what, format, path, name]) =>
        el(
          'li',
          {},
          button(
            `${what}, ${format}`,
            async () => {
              try {
                save(name, await (await call('GET', path)).blob());
                told.textContent = '';
              } catch (error) {
                told.textContent = `${what} (${format}): ${error.message}`;
              }
            },
            {class: 'small', 'data-file': name},
          ),
        ),
      ),
    ),
    told,
  );
}

/** A stress field goes by the name that the request gave it. */
function fieldFiles({request, stress_fields: fields}, i, base) {
  const asked = request.report?.stress_fields ?? [];
  // What the path did not reach is left out of the answer: then only load factors tell which is which.
  const name =
    asked.length === fields.length && typeof asked[i] === 'string' ? asked[i] : String(fields[i].load_factor);
  return ['csv', 'vtu'].map(format => [
    `Stress, ${name.replaceAll('_', ' ')}`,
    format === 'csv' ? 'CSV' : 'VTU (ParaView)',
    `${base}/${name}?f=${format}`,
    `stress-${name}.${format}`,
  ]);
}
