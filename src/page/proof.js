// What the browser finds when it proves an answer anew.

import {check} from './certificate.js';
import {el} from './dom.js';

const VERDICTS = {
  true: [
    'holds',
    '✓ The certificate holds',
    'Checked in this browser, from the answer alone, by a script that shares nothing with the program that found it.',
  ],
  false: [
    'fails',
    '✗ The certificate does not hold',
    'At least one claim of the answer was not proved in this browser. Do not rely on this answer.',
  ],
  null: ['none', 'No certificate', ''],
};

/** Where the service itself cannot say what happens, a proof of the window is none of the outcome. */
const WINDOW_ONLY = [
  'none',
  'The limit window alone is proved',
  'What limit analysis allows was checked in this browser and holds. The outcome is another matter: see the headline and the notes.',
];
const NOT_BY_LIMITS = ['cannot_tell', 'slides_as_built'];

export function proofBox(answer) {
  const {proved, claims, why} = check(answer);
  const [kind, title, words] = proved && NOT_BY_LIMITS.includes(answer.outcome) ? WINDOW_ONLY : VERDICTS[proved];
  return el(
    'section',
    {class: `certificate ${kind}`, 'aria-labelledby': 'certificate-title'},
    el('h3', {id: 'certificate-title'}, title),
    el('p', {}, why ?? words),
    claims.length > 0 &&
      el(
        'details',
        {open: proved === false},
        el('summary', {}, `${claims.length} claims`),
        el(
          'ul',
          {},
          claims.map(({holds, text}) =>
            el('li', {class: holds ? 'holds' : 'fails'}, `${holds ? '✓' : '✗ Not proved:'} ${text}`),
          ),
        ),
      ),
  );
}
