// The list of jobs: many of them, cancel, clone, edit, and what becomes of them when the service goes.

import assert from 'node:assert/strict';
import {SMALL, draft, judged, long, text} from './tools.mjs';

const row = (page, id) => page.locator(`.job[data-id="${id}"]`);

/** A job is followed, cancelled, cloned and edited from the list. */
export async function cancelCloneAndEdit(tools) {
  const service = await tools.serve();
  const running = await service.submit(long(tools.request('first-arch')), 0);
  const waiting = await service.submit({...SMALL, name: 'Waiting'}, 0);
  const page = await tools.page('/', {service});
  await text(page, `[data-id="${running.job_id}"] .words`, '%');
  await text(page, `[data-id="${waiting.job_id}"] .words`, 'in the queue');
  await row(page, running.job_id).getByRole('button', {name: 'Cancel Long'}).click();
  await text(page, `[data-id="${running.job_id}"] .badge`, 'cancelled');
  await text(page, `[data-id="${waiting.job_id}"] .badge`, 'done');
  await row(page, waiting.job_id).getByRole('button', {name: 'Clone Waiting'}).click();
  await page.waitForSelector('#headline');
  const clone = page.url().split('/').at(-1);
  assert.notEqual(clone, waiting.job_id);
  const requests = await Promise.all(
    [waiting.job_id, clone].map(async id => (await service.call('GET', `/v1/jobs/${id}/request`)).text()),
  );
  assert.equal(requests[0], requests[1]);
  await page.getByRole('button', {name: 'Edit a copy'}).click();
  await judged(page);
  await page.fill('#f-arch-voussoirs', '9');
  await judged(page);
  assert.equal((await draft(page)).arch.voussoirs, 9);
  await page.click('#analyse');
  await page.waitForSelector('#headline');
  await page.getByRole('button', {name: /^Forget/}).click();
  await page.waitForSelector(`[data-id="${clone}"]`);
  assert.equal(await page.locator('.job').count(), 3);
}

/** A job that fails says why. */
export async function aFailureSaysWhy(tools) {
  const service = await tools.serve('--job-time', '1');
  const {job_id: id} = await service.submit(long(tools.request('first-arch')), 0);
  const page = await tools.page(`/#/jobs/${id}`, {service});
  await text(page, '.badge', 'failed');
  assert.ok((await page.textContent('.problem')).includes('1 s'));
}

/** The service is killed: the page says so; started again, it says which jobs are lost, and sends one of them again. */
export async function theServiceIsKilledAndComesBack(tools) {
  const service = await tools.serve();
  const page = await tools.page('/#/new/arch', {service});
  await judged(page);
  await page.click('#analyse');
  await page.waitForSelector('#headline');
  const id = page.url().split('/').at(-1);
  const other = await service.submit(long(tools.request('first-arch')), 0);
  await page.click('.top nav a[href="#/"]');
  await text(page, `[data-id="${other.job_id}"] .words`, '%');
  await service.kill();
  await page.waitForSelector('#away:not([hidden])');
  await service.begin();
  await page.waitForSelector('#away', {state: 'hidden'});
  for (const lost of [id, other.job_id]) await text(page, `[data-id="${lost}"] .badge`, 'lost');
  assert.equal(
    await row(page, other.job_id).getByRole('button', {name: /Clone/}).count(),
    0,
    'its request is not known here',
  );
  await page.reload();
  await text(page, `[data-id="${id}"] .badge`, 'lost');
  await row(page, id).locator('.name').click();
  await text(page, '.body', 'Clone submits its request again');
  await page.getByRole('button', {name: /^Clone/}).click();
  await page.waitForSelector('#headline');
}

/** Of a thousand jobs the newest are listed in less than a second, and all of them on demand. */
export async function aThousandJobs(tools) {
  const service = await tools.serve('--queue', '4000');
  await service.submit(long(tools.request('first-arch')), 0);
  for (let i = 0; i < 1000; i += 20) {
    await Promise.all(Array.from({length: 20}, (_, k) => service.submit({...SMALL, name: `Job ${i + k}`}, 0)));
  }
  const page = await tools.page('/', {service});
  await page.waitForFunction(() => document.querySelectorAll('.job').length === 100);
  await page.getByRole('button', {name: 'Show older jobs'}).click();
  await page.waitForFunction(() => document.querySelectorAll('.job').length === 1001);
  const times = await page.evaluate(async () => {
    const {jobsView} = await import('/page/jobs.js');
    const nothing = () => {};
    const times = [];
    for (let i = 0; i < 3; i++) {
      const clock = performance.now();
      const view = jobsView(nothing, nothing);
      document.getElementById('main').replaceChildren(view.node);
      while (view.node.querySelectorAll('.job').length < 100) await new Promise(requestAnimationFrame);
      times.push(performance.now() - clock);
      view.stop();
    }
    return times;
  });
  assert.ok(Math.min(...times) < 1000, `${times} ms`);
}
