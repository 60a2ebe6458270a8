// An answer on the page: live progress, the slider, values, curves, the joint table, exports.

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {long, text} from './tools.mjs';

const picture = page => page.evaluate(() => document.querySelector('.stones').toDataURL());

/** Moves the slider and waits until the drawing is another one. */
async function slide(page, to) {
  const before = await picture(page);
  await page.evaluate(to => {
    const slider = document.getElementById('slider');
    slider.value = to < 0 ? slider.max : to;
    slider.dispatchEvent(new Event('input'));
  }, to);
  await page.waitForFunction(before => document.querySelector('.stones').toDataURL() !== before, before);
  return page.textContent('.told');
}

/** From as built along the load path and through the collapse. */
export async function theSliderMovesTheStructure(tools) {
  const {job_id: id} = await tools.service.submit({
    ...tools.request('first-arch'),
    motion: {most_frames: 40},
    report: {history: true},
  });
  const page = await tools.page(`/#/jobs/${id}`);
  await page.waitForSelector('#headline');
  assert.equal(
    await page.textContent('#headline'),
    'The arch collapses at 221.1 kN/m, as its joints crush; if its stone did not crush, at 243.1 kN/m.',
  );
  await page.waitForFunction(() => document.querySelectorAll('.happening').length > 0);
  assert.equal(await slide(page, 0), 'As built');
  assert.equal(await page.locator('.happening').count(), 0, 'nothing happens before the collapse');
  assert.match(await slide(page, 20), /kN\/m, load factor .*largest displacement .* mm/);
  assert.match(await slide(page, -1), /^Motion after collapse, true to size: largest displacement .* m$/);
  assert.equal(await page.locator('.happening.hinge').count(), 4);
  await page.focus('#slider');
  await page.keyboard.press('Home');
  await text(page, '.told', 'As built');
  await page.click('#play');
  await text(page, '.told', 'load factor');
  await page.click('#play');
}

/** Values under the pointer, or of a stone by its name; the stress in colour. */
export async function valuesOfAStone(tools) {
  const {job_id: id} = await tools.service.submit({
    ...tools.request('first-arch'),
    report: {stress_fields: ['unit_load']},
  });
  const answer = await tools.service.results(id);
  const page = await tools.page(`/#/jobs/${id}`);
  await page.waitForSelector('.legend');
  const named = page.getByLabel('Values of');
  await named.selectOption({label: 'voussoir 13'});
  const mega = Number((answer.stress_fields[0].subblocks.tresca_pa[13] / 1e6).toPrecision(4));
  assert.ok(
    (await page.textContent('.stage .readout')).startsWith(`voussoir 13; equivalent stress (tresca) ${mega} MPa`),
  );
  const swept = words =>
    page.evaluate(words => {
      const readout = document.querySelector('.stage .readout'),
        view = document.querySelector('.stage .view'),
        frame = view.getBoundingClientRect();
      for (let x = 0.3; x < 0.7; x += 0.02) {
        for (let y = 0; y < frame.height; y += 3) {
          view.dispatchEvent(
            new PointerEvent('pointermove', {clientX: frame.left + frame.width * x, clientY: frame.top + y}),
          );
          if (readout.textContent.startsWith(words)) return readout.textContent;
        }
      }
      return null;
    }, words);
  const line = answer.ends[0].thrust_line,
    said = await swept('joint');
  const [, joint, normal] = said.match(/^joint (\d+): normal ([\d.]+) kN/);
  assert.equal(Number(normal), Number((line.normal_n_per_m[joint] / 1e3).toPrecision(4)));
  await slide(page, 0);
  assert.equal(await swept('joint'), null, 'forces are those of the collapse');
  assert.match(await swept('voussoir 13'), /^voussoir 13; equivalent stress/);
  const before = await picture(page);
  await page.getByLabel('Quantity').selectOption({label: 'Smaller principal stress'});
  await page.waitForFunction(before => document.querySelector('.stones').toDataURL() !== before, before);
}

/** The joint table as tab-separated values, as numbers of the answer. */
export async function theJointTableIsCopied(tools) {
  const {job_id: id} = await tools.service.submit(tools.request('two-span-bridge'));
  const answer = await tools.service.results(id);
  const page = await tools.page(`/#/jobs/${id}`, {permissions: ['clipboard-read', 'clipboard-write']});
  await page.click('#copy-joints');
  await text(page, '#joints-title ~ p', 'copied');
  const [head, ...rows] = (await page.evaluate(() => navigator.clipboard.readText()))
    .split('\n')
    .map(line => line.split('\t'));
  assert.equal(rows.length, answer.structure.joints.length);
  assert.deepEqual(head.slice(0, 3), ['joint', 'between', 'normal_n_per_m']);
  const {joint, normal_n_per_m: normal} = answer.ends[0].thrust_line;
  joint.forEach((k, i) => assert.equal(Number(rows[k][2]), normal[i]));
  const hinges = rows.filter(row => row[6].includes('hinge')).map(row => Number(row[0]));
  assert.deepEqual(
    hinges,
    answer.ends[0].hinges.map(hinge => hinge.joint),
  );
}

/** Every export is what the service has. */
export async function exportsAreTheServicesBytes(tools) {
  const {job_id: id} = await tools.service.submit({
    ...tools.request('first-arch'),
    report: {history: true, stress_fields: ['near_collapse']},
  });
  const page = await tools.page(`/#/jobs/${id}`);
  await page.waitForSelector('.exports');
  const files = {
    'answer.json': '',
    'answer.txt': '?f=text',
    'history.csv': '/history?f=csv',
    'figure.svg': '/figure',
    'figure.png': '/figure?f=png',
    'report.pdf': '/report?f=pdf',
    'stress-near_collapse.csv': '/fields/near_collapse?f=csv',
    'stress-near_collapse.vtu': '/fields/near_collapse?f=vtu',
  };
  assert.equal(await page.locator('.exports button').count(), Object.keys(files).length + 1);
  for (const [name, path] of Object.entries(files)) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(`.exports [data-file="${name}"]`)]);
    const expected = await (await tools.service.call('GET', `/v1/jobs/${id}/results${path}`)).arrayBuffer();
    assert.ok(readFileSync(await download.path()).equals(Buffer.from(expected)), name);
    assert.equal(download.suggestedFilename(), name);
  }
}

/** Progress comes by itself, until the job is cancelled. */
export async function progressIsLive(tools) {
  const {job_id: id} = await tools.service.submit(long(tools.request('first-arch')), 0);
  const page = await tools.page(`/#/jobs/${id}`);
  const share = () => page.evaluate(() => document.querySelector('.live progress').value);
  await page.waitForFunction(() => document.querySelector('.live progress').value > 0);
  const first = await share();
  await page.waitForFunction(first => document.querySelector('.live progress').value > first, first);
  assert.match(await page.textContent('#progress-words'), /%, .* s/);
  await page.getByRole('button', {name: /^Cancel/}).click();
  await text(page, '.badge', 'cancelled');
  assert.equal((await (await tools.service.call('GET', `/v1/jobs/${id}`)).json()).status, 'dismissed');
}

/** A curve, two ends and a settlement are answers as well. */
export async function otherAnswers(tools) {
  for (const [name, seen] of [
    ['paper/figure-13', 'does not stand'],
    ['paper/table-4', 'stands only between'],
    ['settlement', 'follows its right springing'],
    ['geometric-safety', ''],
    ['resisting-backfill', 'collapses'],
  ]) {
    const {job_id: id} = await tools.service.submit(tools.request(name));
    const page = await tools.page(`/#/jobs/${id}`);
    await page.waitForSelector('#headline');
    assert.ok((await page.textContent('#headline')).includes(seen), name);
    await tools.picture(`answer-${name.replace('/', '-')}`, page);
  }
  const {job_id: id} = await tools.service.submit({
    curved_beam: {inner_radius_m: 0.5, outer_radius_m: 0.7, end_shear_n_per_m: 2500},
  });
  const page = await tools.page(`/#/jobs/${id}`);
  await page.waitForSelector('.legend');
  assert.ok((await page.textContent('.certificate')).includes('No certificate'));
}
