// A program that serves, a browser, and ways to wait for what is to come. Nothing here waits for a time: only for something to happen.

import {chromium} from 'playwright-core';
import {once} from 'node:events';
import {readFileSync, mkdirSync} from 'node:fs';
import {createServer} from 'node:net';
import {execFile, spawn} from 'node:child_process';
import {promisify} from 'node:util';
import assert from 'node:assert/strict';

const {CHROMIUM} = process.env;
const PATIENCE = 20_000;
const run = promisify(execFile);

/** A port that was free a moment ago. */
async function freePort() {
  const server = createServer().listen(0, '127.0.0.1');
  await once(server, 'listening');
  const {port} = server.address();
  server.close();
  await once(server, 'close');
  return port;
}

/** The program, serving at an address. */
export class Service {
  static async start(program, flags = [], port = undefined) {
    const service = new Service();
    service.program = program;
    service.flags = flags;
    service.port = port ?? (await freePort());
    service.url = `http://127.0.0.1:${service.port}`;
    await service.begin();
    return service;
  }

  async begin() {
    const bind = `127.0.0.1:${this.port}`;
    this.process = spawn(this.program, ['serve', '--bind', bind, '--log', 'warn', '--workers', '1', ...this.flags], {
      stdio: ['ignore', 'inherit', 'inherit'],
    });
    const healthy = () =>
      run(this.program, ['health', '--bind', bind]).then(
        () => true,
        () => false,
      );
    while (!(await healthy())) assert.equal(this.process.exitCode, null, 'the service does not start');
  }

  /** Ends it as a loss of power would. */
  async kill() {
    this.process.kill('SIGKILL');
    await once(this.process, 'exit');
  }

  async call(method, path, body, headers = {}) {
    const answer = await fetch(this.url + path, {
      method,
      headers: {'content-type': 'application/json', ...headers},
      body: body && JSON.stringify(body),
    });
    return answer;
  }

  /** The status of a job that was submitted and, if wished, has ended. */
  async submit(request, wait = 20) {
    const answer = await this.call('POST', '/v1/jobs', request, wait > 0 ? {prefer: `wait=${wait}`} : {});
    assert.ok(answer.ok, await answer.clone().text());
    return answer.json();
  }

  async results(id, query = '') {
    const answer = await this.call('GET', `/v1/jobs/${id}/results${query}`);
    return query ? answer.text() : answer.json();
  }
}

export class Tools {
  static async start(program, root) {
    const tools = new Tools();
    Object.assign(tools, {program, root, troubles: [], contexts: [], services: []});
    tools.browser = await chromium.launch({
      executablePath: CHROMIUM,
      args: ['--no-sandbox', '--disable-dev-shm-usage'],
    });
    tools.service = await Service.start(program, ['--queue', '4000']);
    return tools;
  }

  /** A service of its own for one trial. */
  async serve(...flags) {
    const service = await Service.start(this.program, flags);
    this.services.push(service);
    return service;
  }

  /** The request of a case. */
  request(name) {
    return JSON.parse(readFileSync(`${this.root}/cases/${name}/request.json`, 'utf8'));
  }

  /** A page of a browser that has not been here before. */
  async page(path = '/', {service = this.service, ...options} = {}) {
    const context = await this.browser.newContext({viewport: {width: 1280, height: 900}, ...options});
    this.contexts.push(context);
    await context.addInitScript(() => {
      globalThis.shifted = 0;
      const count = list =>
        list.getEntries().forEach(entry => {
          globalThis.shifted += entry.value;
        });
      new PerformanceObserver(count).observe({type: 'layout-shift', buffered: true});
    });
    const page = (this.shown = await context.newPage());
    page.setDefaultTimeout(PATIENCE);
    page.on('pageerror', error => this.troubles.push(`${error.stack}`));
    page.on('console', message => {
      if (/Content Security Policy|Refused to/.test(message.text())) this.troubles.push(message.text());
    });
    await page.goto(service.url + path);
    await page.waitForSelector('html[data-ready]');
    return page;
  }

  /** No page threw, and none broke its policy. */
  quiet() {
    const troubles = this.troubles.splice(0);
    assert.deepEqual(troubles, []);
  }

  async picture(name, page = this.shown) {
    if (!process.env.SCREENSHOTS || !page || page.isClosed()) return;
    mkdirSync(process.env.SCREENSHOTS, {recursive: true});
    await page.screenshot({path: `${process.env.SCREENSHOTS}/${name}.png`, fullPage: true});
  }

  async clear() {
    this.troubles.length = 0;
    for (const context of this.contexts.splice(0)) await context.close();
    for (const service of this.services.splice(0)) await service.kill();
  }

  async stop() {
    await this.browser.close();
    await this.service.kill();
  }
}

/** Waits until a text is on the page. */
export const text = (page, selector, words) =>
  page.waitForFunction(
    ([selector, words]) => document.querySelector(selector)?.textContent.includes(words),
    [selector, words],
  );

/** Waits until the service has judged the draft so. */
export const judged = (page, words = 'understands') => text(page, '.state:not([aria-busy])', words);

/** What the form would send. */
export const draft = async page => JSON.parse(await page.inputValue('#json'));

/** A small arch that is solved at once. */
export const SMALL = {
  name: 'Small',
  arch: {profile: {circular: {span_m: 4, rise_m: 1}}, thickness: {constant_m: 0.5}, voussoirs: 7},
  loads: [{load: {self_weight: {}}}, {load: {point_load: {force_n_per_m: 1000, x_m: -1}}, scaled: true}],
};

/** One that takes long, and says how far it has come: safety at as many abscissae as there may be, first yield along whole load paths. */
export function long(request) {
  const [weight, load] = request.loads;
  return {
    ...request,
    name: 'Long',
    arch: {...request.arch, voussoirs: 490},
    loads: [weight, {...load, per_abscissa: true}],
    analysis: {safety: {crushing: 'elastic', curve: {abscissae: Array.from({length: 500}, (_, i) => 1 + i / 4), unit: 'kN/m'}}},
  };
}
