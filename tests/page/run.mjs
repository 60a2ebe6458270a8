// Runs every trial, one after the other, and says how long each took. A trial that throws has failed; so has one during which the page
// broke its own policy or threw.

import {Tools} from './tools.mjs';
import * as answers from './answers.mjs';
import * as form from './form.mjs';
import * as jobs from './jobs.mjs';
import * as looks from './looks.mjs';
import * as proof from './proof.mjs';
import * as tokens from './tokens.mjs';

const [, , program, root] = process.argv;
const tools = await Tools.start(program, root);
const only = process.env.ONLY ?? '';
let failed = 0;
for (const [name, trial] of [form, answers, proof, jobs, tokens, looks]
  .flatMap(Object.entries)
  .filter(([name]) => name.includes(only))) {
  const clock = performance.now();
  try {
    await trial(tools);
    tools.quiet();
    console.log(`${name}: ${Math.round(performance.now() - clock)} ms`);
  } catch (error) {
    failed += 1;
    console.error(`${name}: FAILED\n${error.stack}`);
    await tools.picture(`failed-${name}`);
  }
  await tools.clear();
}
await tools.stop();
process.exit(failed > 0 ? 1 : 0);
