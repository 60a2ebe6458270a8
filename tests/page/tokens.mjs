// A service with tokens: asked for once, for streams and downloads as well, and in no address.

import assert from 'node:assert/strict';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {tmpdir} from 'node:os';
import {SMALL, judged, long, text} from './tools.mjs';

const TOKEN = 'a-token-of-this-trial';

export async function aTokenIsAskedForOnce(tools) {
  const service = await tools.serve('--token', TOKEN);
  const page = await tools.page('/', {service});
  const addresses = [];
  page.on('request', request => addresses.push(request.url()));
  const enter = async token => {
    await page.waitForSelector('dialog[open]');
    await page.fill('#token-field', token);
    await page.getByRole('button', {name: 'Use this token'}).click();
  };
  await enter('another');
  await text(page, 'dialog', 'does not know this token');
  await enter(TOKEN);
  await text(page, '#jobs-title ~ p', 'No jobs yet');
  await page.click('a[href="#/new/arch"]');
  await judged(page);
  await page.click('#analyse');
  await page.waitForSelector('.certificate.holds');
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.click('.exports [data-file="figure.svg"]'),
  ]);
  assert.ok(readFileSync(await download.path(), 'utf8').startsWith('<svg'));
  const authorised = {authorization: `Bearer ${TOKEN}`};
  const answer = await service.call('POST', '/v1/jobs', long(tools.request('first-arch')), authorised);
  const {job_id: id} = await answer.json();
  await page.evaluate(id => {
    location.hash = `#/jobs/${id}`;
  }, id);
  await page.waitForFunction(() => document.querySelector('.live progress')?.value > 0);
  await page.getByRole('button', {name: /^Cancel/}).click();
  await text(page, '.badge', 'cancelled');
  assert.ok(
    addresses.some(address => address.includes('/v1/events?')),
    'the stream was followed by a link',
  );
  assert.ok(addresses.every(address => !address.includes(TOKEN)));
  await page.reload();
  await text(page, '.badge', 'cancelled');
  await page.getByRole('button', {name: 'Forget token'}).click();
  await page.waitForSelector('dialog[open]');
}

/** Who may only read is told so where the page would write. */
export async function aTokenThatMayOnlyRead(tools) {
  const folder = mkdtempSync(join(tmpdir(), 'voussoir-tokens-'));
  writeFileSync(join(folder, 'tokens'), 'assessor submit,read writes\ndashboard read-all reads\n');
  const service = await tools.serve('--token-file', join(folder, 'tokens'));
  const answer = await service.call('POST', '/v1/jobs', SMALL, {authorization: 'Bearer writes', prefer: 'wait=20'});
  const {job_id: id} = await answer.json();
  const page = await tools.page(`/#/jobs/${id}`, {service});
  await page.waitForSelector('dialog[open]');
  await page.fill('#token-field', 'reads');
  await page.keyboard.press('Enter');
  await page.waitForSelector('.certificate.holds');
  await page.getByRole('button', {name: /^Clone/}).click();
  await text(page, '#told', 'role submit');
  await page.getByRole('button', {name: 'Edit a copy'}).click();
  await judged(page, 'role submit');
  rmSync(folder, {recursive: true});
}
