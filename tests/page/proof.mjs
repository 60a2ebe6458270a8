// The certificate as the browser checks it, against cases/check.py; and the outline that is drawn as one types, against the structure
// of the answer.

import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {SMALL, text} from './tools.mjs';

const CASES = [
  'first-arch',
  'half-arch',
  'sliding-arch',
  'sliding-range',
  'resisting-backfill',
  'crushing',
  'two-span-bridge',
  'wall',
  'settlement',
  'paper/table-4',
  'paper/figure-6',
];

/** Ways to spoil an answer, each of which breaks its proof. */
const SPOILT = {
  'a higher collapse load': answer => {
    answer.ends[0].load_factor *= 1.001;
  },
  'a wider window': answer => {
    answer.limit_window_load_factor[1] *= 1.001;
  },
  'a force that is not there': answer => {
    answer.proof.highest.forces.shear_n_per_m[3] += 1000;
  },
  'a heavier stone': answer => {
    answer.structure.bodies[5].fixed_load.y_n_per_m *= 1.01;
  },
  'a motion that joints hinder': answer => {
    answer.proof.highest.motion.y[4] *= -1;
  },
};

const checkInBrowser = (page, answer) =>
  page.evaluate(async answer => (await import('/page/certificate.js')).check(answer).proved, answer);

/** Python and the browser say the same of every answer, sound and spoilt. */
export async function theBrowserProvesWhatPythonProves(tools) {
  const page = await tools.page();
  const folder = mkdtempSync(join(tmpdir(), 'voussoir-answers-'));
  const answers = [];
  for (const name of CASES) {
    const {job_id: id} = await tools.service.submit(tools.request(name));
    answers.push([name, true, await tools.service.results(id)]);
  }
  for (const [what, spoil] of Object.entries(SPOILT)) {
    const answer = structuredClone(answers[0][2]);
    spoil(answer);
    answers.push([what, false, answer]);
  }
  const files = answers.map(([, , answer], i) => {
    writeFileSync(join(folder, `${i}.json`), JSON.stringify(answer));
    return join(folder, `${i}.json`);
  });
  const python = spawnSync('python3', [join(tools.root, 'cases/check.py'), ...files], {encoding: 'utf8'}).stdout.split(
    '\n',
  );
  rmSync(folder, {recursive: true});
  for (const [i, [what, sound, answer]] of answers.entries()) {
    assert.equal(!python[i].includes('NOT PROVED'), sound, `${what}: ${python[i]}`);
    assert.equal(await checkInBrowser(page, answer), sound, what);
  }
}

/** Green only if it holds: the same answer, spoilt on its way to the page, is red. */
export async function greenOnlyIfItHolds(tools) {
  const {job_id: id} = await tools.service.submit(tools.request('first-arch'));
  const sound = await tools.page(`/#/jobs/${id}`);
  assert.ok(await sound.waitForSelector('.certificate.holds'));
  const page = await tools.page('/');
  const answer = await tools.service.results(id);
  answer.proof.highest.motion = null;
  assert.equal(await checkInBrowser(page, answer), false, 'a proof of which a part is missing is none');
  await page.route(`**/v1/jobs/${id}/results`, async route => {
    const answer = await (await route.fetch()).json();
    SPOILT['a heavier stone'](answer);
    await route.fulfill({json: answer});
  });
  await page.evaluate(id => {
    location.hash = `#/jobs/${id}`;
  }, id);
  await page.waitForSelector('.certificate.fails');
  assert.ok((await page.textContent('.certificate')).includes('Do not rely'));
  assert.equal(await page.locator('.certificate.holds').count(), 0);
  const hair = {...SMALL, arch: {...SMALL.arch, thickness: {constant_m: 1e-6}}};
  const {job_id: slender} = await tools.service.submit(hair);
  assert.equal((await tools.service.results(slender)).outcome, 'cannot_tell');
  await page.evaluate(id => {
    location.hash = `#/jobs/${id}`;
  }, slender);
  await text(page, '.certificate.none', 'limit window alone');
}

/** Where an intensity means nothing none is shown. */
export async function noLoadWhereNoneMeansAnything(tools) {
  const thin = {
    profile: {circular: {radius_m: 5, opening_angle_deg: 180}},
    thickness: {constant_m: 0.2},
    voussoirs: 20,
  };
  const {job_id: id} = await tools.service.submit({...SMALL, arch: thin});
  assert.equal((await tools.service.results(id)).outcome, 'falls_as_built');
  const page = await tools.page(`/#/jobs/${id}`);
  await page.waitForSelector('.facts');
  const terms = await page.locator('.facts dt').allTextContents();
  assert.ok(terms.includes('Mode') && !terms.some(term => term.startsWith('Collapse')), `${terms}`);
}

const DRAWN = {
  pointed: {},
  'half-arch': {},
  wall: {},
  'paper/figure-13': {analysis: 'collapse'},
  'paper/figure-6': {},
  'two-span-bridge': {
    bridge: {
      spans: [
        {
          profile: {elliptical: {span_m: 6, rise_m: 2}},
          rings: [
            {thickness_m: 0.4, voussoirs: 15},
            {thickness_m: 0.3, springing_thickness_m: 0.5, voussoirs: 15},
          ],
        },
        {profile: {pointed: {span_m: 5, rise_m: 3}}, rings: [{thickness_m: 0.5, voussoirs: 12}]},
      ],
      piers: [{top_width_m: 2, height_m: 3, courses: 3, batter: 0.05}],
      abutments: {left: {height_m: 2}, right: {height_m: 2.5, width_m: 2}},
      backing: {level_m: 1.2},
    },
  },
};

/** What is drawn as one types is what is analysed, corner by corner. */
export async function theOutlineIsTheStructure(tools) {
  const page = await tools.page();
  for (const [name, more] of Object.entries(DRAWN)) {
    const request = {...tools.request(name), ...more, loads: [{load: {self_weight: {}}}]};
    const {job_id: id} = await tools.service.submit(request);
    const {structure} = await tools.service.results(id);
    const stones = await page.evaluate(
      async request => (await import('/page/outline.js')).outline(request).stones,
      request,
    );
    assert.equal(stones.length, structure.bodies.length, name);
    stones.forEach((corners, k) =>
      corners.forEach(([x, y]) => {
        const nearest = Math.min(...structure.bodies[k].corners_m.map(([a, b]) => Math.hypot(a - x, b - y)));
        assert.ok(nearest < 1e-9, `${name}, ${structure.bodies[k].name}: ${nearest} m`);
      }),
    );
  }
}
