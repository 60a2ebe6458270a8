// The view of an answer, from its headline to its exports.

import {Stage} from './stage.js';
import {call, get} from './api.js';
import {curvesOf} from './curves.js';
import {el, table} from './dom.js';
import {exportsOf} from './exports.js';
import {facts} from './facts.js';
import {figures, words} from './number.js';
import {jointTable} from './joints.js';
import {proofBox} from './proof.js';

export async function answerView(id) {
  const results = `/v1/jobs/${id}/results`;
  const [answer, text] = await Promise.all([get(results), call('GET', `${results}?f=text`).then(said => said.text())]);
  const drawable = answer.structure || answer.subblocks;
  return el(
    'div',
    {class: 'answer'},
    el('p', {class: 'headline', id: 'headline'}, headline(text, answer.request.name)),
    el(
      'div',
      {class: 'two'},
      el('div', {class: 'wide'}, drawable && new Stage(answer).node, curvesOf(answer)),
      el('div', {class: 'narrow'}, proofBox(answer), facts(answer), exportsOf(id, answer)),
    ),
    notes(answer),
    safetyTable(answer),
    answer.structure && jointTable(answer.structure, answer.ends[0]),
    el(
      'details',
      {class: 'pane'},
      el('summary', {}, 'The whole answer in words'),
      el('pre', {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'The answer in words'}, text),
    ),
  );
}

/** The first words of the answer for people, after its name. */
function headline(text, name) {
  const body = name && text.startsWith(name) ? text.slice(name.length) : text;
  return body.trimStart().split('\n\n')[0].replace(/\s+/g, ' ').trim();
}

function notes(answer) {
  const all = [
    ...new Set([
      ...(answer.notes ?? []),
      ...(answer.safety?.notes ?? []),
      ...(answer.points ?? []).flatMap(point => point.notes),
    ]),
  ];
  return (
    all.length > 0 &&
    el(
      'section',
      {class: 'notes', 'aria-labelledby': 'notes-title'},
      el('h3', {id: 'notes-title'}, 'Know before you use the numbers'),
      el(
        'ul',
        {},
        all.map(note => el('li', {}, note)),
      ),
    )
  );
}

function safetyTable({points, unit}) {
  if (!points) return null;
  const state = factor => (factor ? (factor.state === 'at' ? figures(factor.load_factor) : words(factor.state)) : '–');
  return el(
    'div',
    {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Safety factors'},
    table(
      [
        unit === '-' ? 'Abscissa' : `Abscissa, ${unit}`,
        'Safety factor',
        'Governed by',
        'Instability',
        'Plastic section',
        'First yield',
        'Mode',
      ],
      points.map(point => [
        figures(point.abscissa),
        state(point.governing),
        words(point.governed_by),
        state(point.instability),
        state(point.plastic_section),
        state(point.elastic),
        point.mode ? words(point.mode) : '–',
      ]),
      'Safety factors',
    ),
  );
}
