// A request by form: three ways to see one draft, loads that move, faults beside their fields, files.

import assert from 'node:assert/strict';
import {draft, judged, text} from './tools.mjs';

/** A new bridge by form, from the empty list to its answer. */
export async function aBridgeByForm(tools) {
  const page = await tools.page();
  await text(page, '#jobs-title ~ p', 'jobs');
  await page.click('a[href="#/new/bridge"]');
  await judged(page);
  await page.fill('#f-name', 'Two spans');
  await page.fill('#f-bridge-piers-0-height_m', '5');
  await page.click('#f-bridge-spans-0-rings-add');
  await page.fill('#f-bridge-spans-0-rings-1-thickness_m', '0.3');
  await judged(page);
  await page.check('#kind-arch');
  await judged(page);
  assert.ok((await draft(page)).arch);
  await page.check('#kind-bridge');
  await judged(page);
  const request = await draft(page);
  assert.equal(request.name, 'Two spans', 'another kind does not spoil this one');
  assert.equal(request.bridge.piers[0].height_m, 5);
  assert.deepEqual(
    request.bridge.spans[0].rings.map(ring => ring.thickness_m),
    [0.4, 0.3],
  );
  await page.click('#analyse');
  await page.waitForSelector('#headline');
  assert.equal(await page.textContent('.jobname'), 'Two spans');
  const said = await tools.service.results(page.url().split('/').at(-1), '?f=text');
  assert.ok(said.replace(/\s+/g, ' ').includes(await page.textContent('#headline')), "the headline is the service's");
  await page.goBack();
  await judged(page);
  assert.equal((await draft(page)).name, 'Two spans', 'a draft is found as it was left');
  await page.click('.top nav a[href="#/new/arch"]');
  await page.waitForSelector('#f-arch-voussoirs');
  await page.fill('#f-name', 'Mine');
  await page.click('.top nav a[href="#/new/arch"]');
  await page.waitForFunction(() => document.getElementById('f-name').value === 'Arch');
}

/** A load on the drawing moves with the pointer and with the keys; field, JSON and drawing follow. */
export async function aLoadIsDragged(tools) {
  const page = await tools.page('/#/new/arch');
  await judged(page);
  const at = async () => (await draft(page)).loads[1].load.point_load.x_m;
  const grip = await page.locator('#load-1 .grip').boundingBox();
  const [x, y] = [grip.x + grip.width / 2, grip.y + grip.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y + 5, {steps: 4});
  await page.mouse.up();
  const dragged = await at();
  assert.ok(dragged > -2.5 && dragged < 0, `${dragged}`);
  assert.equal(await page.inputValue('#f-loads-1-load-point_load-x_m'), String(dragged));
  await page.focus('#load-1');
  await page.keyboard.press('ArrowRight');
  const stepped = await at();
  assert.ok(stepped > dragged && stepped < dragged + 0.2, `${stepped}`);
  await page.waitForFunction(() => document.activeElement?.id === 'load-1');
  await page.fill('#f-loads-1-load-point_load-x_m', '3.25');
  await page.waitForFunction(() => document.getElementById('load-1').getAttribute('aria-valuenow') === '3.25');
}

/** What is written as JSON comes into the fields, and what is no JSON is said to be none. */
export async function theJsonBesideIt(tools) {
  const page = await tools.page('/#/new/arch');
  await judged(page);
  const request = await draft(page);
  request.arch.thickness = {linear: {crown_m: 0.5, springing_m: 0.9}};
  request.joint_overrides = [{joint: 3, friction_angle_deg: 20}];
  await page.fill('#json', JSON.stringify(request));
  assert.equal(await page.inputValue('#f-arch-thickness-linear-springing_m'), '0.9');
  await judged(page);
  await page.fill('#json', '{"arch": ');
  await text(page, '#json-fault', 'no request');
  await page.fill('#json', JSON.stringify(request));
  await page.fill('#f-arch-voussoirs', '31');
  assert.deepEqual((await draft(page)).joint_overrides, request.joint_overrides, 'what has no field stays');
}

/** Other stones, altered joints, and a road over layers of fill. */
export async function stonesJointsAndFill(tools) {
  const page = await tools.page('/#/new/arch');
  await judged(page);
  await page.click('#s-stone > summary');
  await page.click('#f-stones-add');
  await page.fill('#f-stones-0-density_kg_m3', '1800');
  await page.click('#f-arch-stone_of-add');
  await page.fill('#f-arch-stone_of-0-to', '3');
  await page.click('#f-joint_overrides-add');
  await page.fill('#f-joint_overrides-0-joint', '4');
  await page.fill('#f-joint_overrides-0-lost_at_intrados_m', '0.05');
  await page.check('#f-backfill');
  await page.fill('#f-backfill-density_kg_m3', '1900');
  await page.selectOption('[id="f-backfill#"]', {label: 'Through points'});
  await page.fill('#f-backfill-surface_m', '-6 6\n0 7\n6 6.5');
  await page.click('#f-backfill-layers-add');
  await page.check('#f-backfill-backing');
  await judged(page);
  const request = await draft(page);
  assert.deepEqual(request.stones, [{name: 'stone 2', density_kg_m3: 1800}]);
  assert.deepEqual(request.arch.stone_of, [{from: 0, to: 3, stone: 'stone 2'}]);
  assert.deepEqual(request.joint_overrides, [{joint: 4, lost_at_intrados_m: 0.05}]);
  const {surface_m, density_kg_m3: density, layers, backing} = request.backfill;
  assert.deepEqual(surface_m[1], [0, 7]);
  assert.deepEqual([density, layers.length, backing.height_m], [1900, 1, 1], 'another surface spoils nothing else');
  await page.selectOption('[id="f-backfill#"]', {label: 'Level'});
  assert.equal((await draft(page)).backfill.surface_height_m, 6);
  assert.equal((await draft(page)).backfill.surface_m, undefined);
}

/** Every fault of the service stands beside its field, and nothing is submitted. */
export async function faultsBesideTheirFields(tools) {
  const page = await tools.page('/#/new/arch');
  await judged(page);
  await page.fill('#f-arch-thickness-constant_m', '-1');
  await page.fill('#f-arch-voussoirs', 'many');
  await judged(page, '2 faults');
  for (const [id, words] of [
    ['f-arch-thickness-constant_m', 'out of range'],
    ['f-arch-voussoirs', 'number'],
  ]) {
    assert.equal(await page.getAttribute(`#${id}`, 'aria-invalid'), 'true');
    assert.ok((await page.textContent(`#${id}-fault`)).includes(words));
  }
  await page.click('#analyse');
  await page.waitForFunction(() => document.activeElement?.id === 'f-arch-thickness-constant_m');
  await page.fill('#f-arch-thickness-constant_m', '0.8');
  await page.fill('#f-arch-voussoirs', '');
  await judged(page, '1 fault');
  assert.ok((await page.textContent('#f-arch-voussoirs-fault')).includes('missing'));
  // A fault of what has no field is told, too.
  await page.fill('#json', JSON.stringify({...(await draft(page)), moon: 1}));
  await text(page, '.fault.list', '/moon');
  assert.equal(new URL(page.url()).hash, '#/new/arch');
}

/** An arch from surveyed points, chosen or dropped; a file that is none says why. */
export async function anArchFromSurveyedPoints(tools) {
  const page = await tools.page('/');
  const points = [
    [-2, 0],
    [-1.4, 0.9],
    [0, 1.4],
    [1.4, 0.9],
    [2, 0],
  ];
  const rows = (side, scale) => points.map(([x, y]) => `${side},${x * scale},${(y * scale).toFixed(3)}`);
  const csv = ['side,x_m,y_m', ...rows('intrados', 1), ...rows('extrados', 1.25).reverse()].join('\n');
  await page.setInputFiles('#file', {name: 'arch of 1840.csv', mimeType: 'text/csv', buffer: Buffer.from(csv)});
  await judged(page);
  const request = await draft(page);
  assert.equal(request.name, 'arch of 1840');
  assert.deepEqual(request.arch.profile.surveyed.intrados_m, points);
  assert.deepEqual(request.arch.profile.surveyed.extrados_m[0], [-2.5, 0]);
  const drop = (name, body) =>
    page.evaluate(
      ([name, body]) => {
        const data = new DataTransfer();
        data.items.add(new File([body], name, {type: 'text/csv'}));
        window.dispatchEvent(new DragEvent('drop', {dataTransfer: data, bubbles: true, cancelable: true}));
      },
      [name, body],
    );
  await drop(
    'inner.csv',
    ['side;x_m;y_m', ...rows('intrados', 1).map(row => row.replaceAll(',', ';').replaceAll('.', ','))].join('\r\n'),
  );
  await text(page, '[data-at="/arch/profile#"] .fault', 'thickness_m');
  await page.fill('#f-arch-profile-surveyed-thickness_m', '0.4');
  await judged(page);
  assert.equal((await draft(page)).arch.profile.surveyed.extrados_m, undefined);
  // Of one face alone, from right to left, two of its points uncertain.
  const uncertain = points.map(([x, y], i) => [x, y, ['', 0.02, '', '', 0.03][i]].join(',')).reverse();
  await drop('uncertain.csv', ['x_m,y_m,tolerance_m', ...uncertain].join('\n'));
  await text(page, '[data-at="/arch/profile#"] .fault', 'thickness_m');
  await page.fill('#f-arch-profile-surveyed-thickness_m', '0.4');
  await judged(page);
  const {analysis, arch} = await draft(page);
  assert.deepEqual(analysis, {survey_tolerance: {intrados_m: [0, 0.02, 0, 0, 0.03]}});
  assert.deepEqual(arch.profile.surveyed.intrados_m, points);
  await drop('bad.csv', 'side,x_m,y_m\nintrados,0,zero');
  await text(page, '#told', 'line 2');
  await drop('request.json', JSON.stringify(tools.request('pointed')));
  await page.waitForFunction(
    () =>
      document.getElementById('f-arch-profile-pointed-span_m') ||
      document.getElementById('f-arch-profile-pointed-radius_m'),
  );
}
