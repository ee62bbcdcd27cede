// Pages as a customer sees them, in Chromium: offline, without a message on the console, without a violation that
// axe-core knows, on a telephone of 390 px, on paper, by keyboard, and without JavaScript.
//
// node pages_test.mjs FRUSTUM SOURCE_FOLDER WORK_FOLDER AXE_SCRIPT
// PDF files stay in the work folder, with pictures unless FRUSTUM_LAWS=reduced. Exit code 77: skipped,
// no Chromium or no axe-core.
import {spawn, spawnSync} from 'node:child_process';
import {once} from 'node:events';
import {existsSync, mkdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import {Browser, findChromium} from './chromium.mjs';
import {checkPlayer} from './player_checks.mjs';

const [frustum, source, work, axe] = process.argv.slice(2);
const chromium = findChromium();
if (!chromium || !existsSync(axe)) {
  console.log(`skipped: ${chromium ? `no axe-core at ${axe}` : 'there is no Chromium (CHROMIUM names one)'}`);
  process.exit(77);
}
rmSync(work, {recursive: true, force: true});
mkdirSync(work, {recursive: true});

let failures = 0;
function expect(holds, page, what) {
  if (holds) return;
  ++failures;
  console.error(`${page}: ${what}`);
}

function run(...args) {
  const {status, stderr} = spawnSync(frustum, args, {cwd: work, encoding: 'utf8'});
  if (status !== 0 && status !== 1) throw new Error(`frustum ${args.join(' ')}: ${stderr}`);
}

// `make test` looks at a few pages of those that `make laws` looks at, and makes no others.
const reduced = process.env.FRUSTUM_LAWS === 'reduced';

// What `frustum serve` answers for the work folder; its links lead nowhere from here.
async function indexPage() {
  const server = spawn(frustum, ['serve', work, '--port', '0', '--json'], {stdio: ['ignore', 'pipe', 'ignore']});
  const [line] = await once(server.stdout, 'data');
  const answer = await fetch(JSON.parse(line).url);
  writeFileSync(join(work, 'index-page.html'), await answer.text());
  server.kill();
}

// Every kind of page; "judged" has one characteristic of each verdict that a CMM of 2 um gives it.
function makePages() {
  run('program', 'cone', '--machine', 'iwf-bc', '--out', 'piece', '--chord-tolerance', '1');
  const job = readFileSync(join(work, 'piece/job.toml'), 'utf8');
  const plan = readFileSync(join(work, 'piece/cone.plan.toml'), 'utf8');
  writeFileSync(join(work, 'piece/judged.plan.toml'),
                plan.replace('"600 urad"', '"20 urad"').replace('"100 um"', '"0.1 um"') +
                    '\n[[characteristic]]\nname = "cylinder.diameter"\nkind = "diameter"\nfeature = "cylinder"\n' +
                    'tolerance = "20 um"\n[[characteristic]]\nname = "cone.coaxiality"\nkind = "coaxiality"\n' +
                    'features = ["cone", "cylinder"]\ndatum_criterion = "om"\ntolerance = "2 um"\n');
  writeFileSync(join(work, 'piece/judged.toml'),
                job.replace('cone.plan.toml', 'judged.plan.toml')
                    .replace('{ e0 = "0 um" }', '{ e0 = "2 um", l_per_um = 300, seed = 1 }\ndecision = "iso14253"') +
                    '\n[report]\npart = "Cone"\nserial_number = "0042"\norder = "4711"\noperator = "A. Example"\n' +
                    'date = "2026-11-23"\ncmm = "CMM 7, no. 12"\n');
  run('run', 'piece/job.toml', '--out', 'ideal', '--quiet');
  run('run', 'piece/judged.toml', '--out', 'judged', '--quiet');
  run('volumetric', 'iwf-bc', '--error', 'EB0Z=20urad', '--error', 'EXX=linear 10um', '--tolerance',
      'displacements=10um', '--tolerance', 'rotations=20urad', '--out', 'volumetric', '--json');
  run('program', 'step', '--machine', 'zx-yac', '--patterns', '1-a,2-a', '--out', 'sheet');
  run('motion', 'run', join(source, 'examples/ballbar/circle.toml'), '--out', 'motion', '--quiet');
  run('view', 'piece/job.toml', '--error', 'EX0C=10um', '--error', 'EB0B=40urad', '--snapshots', '4', '--pitch', '3', '--out',
      'player', '--quiet');
  run('dynamics', 'iwf-bc', '--axes', 'Z=300', '--tool-length', '150', '--frf', '20:60', '--out', 'dynamics', '--json');
  const few = {
    ideal: 'ideal/report.html',
    judged: 'judged/report.html',
    volumetric: 'volumetric/volumetric.html',
    motion: 'motion/motion.html',
    sheet: 'sheet/setup.html',
    player: 'player/view.html',
    dynamics: 'dynamics/report.html',
    index: 'index-page.html',
  };
  if (reduced) return few;
  run('run', join(source, 'examples/ibaraki-2010/workpiece-1/job.toml'), '--out', 'step', '--quiet');
  run('sensitivity', join(source, 'examples/ibaraki-2010/workpiece-1/job.toml'), '--out', 'sensitivity', '--json');
  writeFileSync(join(work, 'study.toml'),
                'target = "volumetric"\nmachine = "dvf5000"\ntool_length = 150\nsamples = 2000\n' +
                    '[errors]\nfile = "jang-general-tolerances"\n[limits]\n"volumetric.error" = "24 um"\n' +
                    '[measurement]\nu = "2 um"\n[risk]\n[shares]\n[allocate]\ncharacteristic = "volumetric.error"\n');
  run('study', 'study.toml', '--out', 'study', '--quiet');
  run('motion', 'chase', 'zx-yac', '--ball', '100,0,100', '--at',
      'A=-60,C=0;A=-60,C=90;A=-60,C=180;A=-60,C=270;A=0,C=0;A=0,C=90;A=0,C=180;A=0,C=270', '--error', 'EX0C=10um',
      '--error', 'EZ0A=6um', '--out', 'r-test', '--quiet');
  run('motion', 'line', 'zx-yac', '--axis', 'X', '--targets=-180,-97,-31,42,111,178', '--error',
      'EXX=linear 10um + reversal 3um', '--noise', '0.3um', '--out', 'line', '--quiet');
  run('run', 'piece/judged.toml', '--out', 'german', '--language', 'de', '--units', 'inch', '--quiet');
  run('history', join(source, 'examples/history'), '--out', 'history', '--quiet');
  return {
    ...few,
    german: 'german/report.html',
    history: 'history/history.html',
    step: 'step/report.html',
    sensitivity: 'sensitivity/sensitivity.html',
    study: 'study/report.html',
    'r-test': 'r-test/motion.html',
    line: 'line/motion.html',
  };
}

const browser = await Browser.start(chromium);
const messages = [];
const requests = [];
browser.on((method, params) => {
  if (method === 'Runtime.consoleAPICalled') messages.push(params.args.map((a) => a.value).join(' '));
  if (method === 'Runtime.exceptionThrown') messages.push(params.exceptionDetails.exception?.description);
  if (method === 'Log.entryAdded') messages.push(params.entry.text);
  if (method === 'Network.requestWillBeSent' && !/^(file|data|blob):/.test(params.request.url)) {
    requests.push(params.request.url);
  }
});

async function picture(name) {
  if (reduced) return;  // for the eyes alone, and a second of drawing without a graphics card
  const {data} = await browser.send('Page.captureScreenshot', {captureBeyondViewport: true});
  writeFileSync(join(work, `${name}.png`), Buffer.from(data, 'base64'));
}

const scheme = (value) =>
    browser.send('Emulation.setEmulatedMedia', {features: [{name: 'prefers-color-scheme', value}]});

async function violations(page, colours) {
  await scheme(colours);
  if (await browser.evaluate('typeof axe') === 'undefined') await browser.evaluate(readFileSync(axe, 'utf8'));
  const found = await browser.evaluate(`axe.run(document, {resultTypes: ['violations']}).then((r) =>
      r.violations.map((v) => v.id + ': ' + v.help + ' (' + v.nodes.slice(0, 3).map((n) => n.html.slice(0, 120)).join(' | ') + ')'))`);
  for (const violation of found) expect(false, page, `${colours}: ${violation}`);
}

const drawn = `document.querySelector('.view') === null || document.querySelector('.live .view canvas') !== null`;
// What is cut, or makes the page scroll sideways.
const overflow = `(() => {
  const wide = document.scrollingElement.scrollWidth - document.documentElement.clientWidth;
  return wide > 0 ? 'the page is ' + wide + ' px too wide' : '';
})()`;
const hiddenCells = `[...document.querySelectorAll('.cards tbody td')].filter((cell) => {
  if (cell.textContent === '') return false;
  const box = cell.getBoundingClientRect();
  const scrolled = cell.closest('.scroll')?.getBoundingClientRect().right ?? Infinity;
  const edge = Math.min(scrolled, document.documentElement.clientWidth);
  return box.width === 0 || box.left < 0 || box.right > edge + 0.5;
}).map((cell) => cell.dataset.label).join(', ')`;

// What `read` gives once it is as wanted. A busy machine takes its time; what never comes is given up after two
// minutes, with what was read last.
async function settled(read, wanted) {
  const end = Date.now() + 120e3;
  let value = await read();
  while (!wanted(value) && Date.now() < end) {
    await browser.evaluate('new Promise((done) => setTimeout(done, 50))');
    value = await read();
  }
  return value;
}

async function checkTelephone(page) {
  await browser.size(390, 844, true);
  const wide = await settled(() => browser.evaluate(overflow), (text) => text === '');  // the view follows its new size
  expect(wide === '', page, `390 px: ${wide}`);
  const hidden = await browser.evaluate(hiddenCells);
  expect(hidden === '', page, `390 px: not seen: ${hidden}`);
  await picture(`${page}-390`);
}

// Attack3_10: the verdict is not beyond the edge of a table that scrolls.
async function checkDesk(page) {
  for (const width of [1440, 1170, 1000]) {
    await browser.size(width, 900, false);
    const hidden = await settled(() => browser.evaluate(hiddenCells), (text) => text === '');
    expect(hidden === '', page, `${width} px: not seen: ${hidden}`);
  }
}

async function checkKeyboard(page) {
  const has = await browser.evaluate(`(() => {
    const view = document.querySelector('.live .view');
    if (!view) return false;
    view.scrollIntoView({block: 'center'});
    return true;
  })()`);
  const isView = await browser.evaluate(`document.querySelector('.view') !== null`);
  expect(has || !isView, page, 'the 3D view is not drawn');
  if (!has) return;
  const shown = () => browser.evaluate(`document.querySelector('.view canvas').toDataURL()`);
  const before = await shown();
  // The wheel over the view scrolls the page unless the view has the focus.
  const {x, y} = await browser.evaluate(`(() => {
    const box = document.querySelector('.view').getBoundingClientRect();
    return {x: box.left + box.width / 2, y: box.top + box.height / 2};
  })()`);
  const scrolled = () => browser.evaluate('window.scrollY');
  const start = await scrolled();
  await browser.send('Input.dispatchMouseEvent', {type: 'mouseWheel', x, y, deltaX: 0, deltaY: -120});
  const moved = await settled(scrolled, (now) => now !== start);
  expect(moved !== start, page, 'the wheel over the 3D view does not scroll the page');
  expect(await shown() === before, page, 'the wheel over the 3D view zooms without Ctrl or focus');
  await browser.evaluate(`document.querySelector('.view').focus()`);
  let last = before;
  for (const key of ['ArrowLeft', 'ArrowDown', '+']) {
    await browser.send('Input.dispatchKeyEvent', {type: 'keyDown', key, text: key === '+' ? '+' : undefined});
    await browser.send('Input.dispatchKeyEvent', {type: 'keyUp', key});
    const now = await settled(shown, (picture) => picture !== last);
    expect(now !== last, page, `${key} does not change the 3D view`);
    last = now;
  }
}

async function checkPaper(page) {
  await browser.send('Emulation.setEmulatedMedia', {media: 'print'});
  const left = await browser.evaluate(`[...document.querySelectorAll('.hint, .tools, canvas, button')].filter((e) =>
      e.getClientRects().length > 0).map((e) => e.className || e.tagName).join(', ')`);
  expect(left === '', page, `on paper: ${left}`);
  await browser.send('Emulation.setEmulatedMedia', {media: ''});
  const {data} = await browser.send('Page.printToPDF', {preferCSSPageSize: true, printBackground: true});
  const file = join(work, `${page}.pdf`);
  writeFileSync(file, Buffer.from(data, 'base64'));
  const {status, stdout} = spawnSync('pdftotext', ['-layout', file, '-'], {encoding: 'utf8'});
  if (status !== 0) return;  // no poppler: the pages are there to be looked at
  const pages = stdout.split('\f').slice(0, -1);
  pages.forEach((text, k) => {
    const words = text.trim().split(/\s+/).length;
    expect(words > 8, page, `on paper: page ${k + 1} has ${words} words`);
    expect(new RegExp(`\\b${k + 1} ?/ ?${pages.length}\\b`).test(text), page, `on paper: page ${k + 1} has no number`);
  });
  expect(!/Drag|wheel/.test(stdout), page, 'on paper: hints for the mouse');
}

// Tables and charts, and a picture of the part, as HTML alone.
async function checkWithoutScript(page, url) {
  await browser.send('Emulation.setScriptExecutionDisabled', {value: true});
  await browser.load(url);
  const {root} = await browser.send('DOM.getDocument');
  const boxes = async (selector) => {
    const {nodeIds} = await browser.send('DOM.querySelectorAll', {nodeId: root.nodeId, selector});
    const seen = await Promise.all(nodeIds.map((nodeId) => browser.send('DOM.getBoxModel', {nodeId}).catch(() => null)));
    return {all: nodeIds.length, seen: seen.filter((box) => box && box.model.height > 40).length};
  };
  const figures = await boxes('figure');
  expect(figures.seen === figures.all, page, `without JavaScript ${figures.all - figures.seen} figures are empty`);
  await picture(`${page}-without-script`);
  await browser.send('Emulation.setScriptExecutionDisabled', {value: false});
}

try {
  const pages = makePages();
  await indexPage();
  await browser.send('Network.emulateNetworkConditions',
                     {offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0});
  for (const [page, file] of Object.entries(pages)) {
    if (reduced && page === 'ideal') continue;  // only its words
    const url = pathToFileURL(join(work, file)).href;
    await browser.size(1200, 900);
    await browser.load(url);
    await settled(() => browser.evaluate(drawn), (is) => is);
    await picture(page);
    const wide = await browser.evaluate(overflow);
    expect(wide === '', page, wide);
    await checkKeyboard(page);
    if (page === 'player') await checkPlayer({browser, expect, settled}, page);
    await violations(page, 'light');
    await violations(page, 'dark');
    await picture(`${page}-dark`);
    await scheme('light');
    await checkTelephone(page);
    await checkDesk(page);
    await browser.size(1200, 900);
    await checkPaper(page);
    expect(messages.length === 0, page, `on the console: ${messages.splice(0).join(' | ')}`);
    await checkWithoutScript(page, url);
    messages.length = 0;
  }
  expect(requests.length === 0, 'all', `asked for: ${requests.join(', ')}`);
  const words = async (page) => {
    await browser.load(pathToFileURL(join(work, pages[page])).href);
    return browser.evaluate('document.body.innerText');
  };
  // What a metrologist asks: what was measured, with what, by which rule, is it inside, how uncertain is it.
  const judged = await words('judged');
  for (const answer of ['0042', '4711', 'A. Example', '2026-11-23', 'CMM 7, no. 12', 'E0 = 2 µm', 'ball diameter',
                        'ISO 14253-1: pass where', 'datums A | C | groove', 'uncertain', 'SHA-256', 'coaxiality of cone to cylinder',
                        'not proven']) {
    expect(judged.includes(answer), 'judged', `does not say "${answer}"`);
  }
  expect((await words('ideal')).includes('U = 0: no error of the CMM is stated'), 'ideal', 'does not say that U = 0');
} finally {
  await browser.close();
}
if (failures > 0) {
  console.error(`${failures} faults; what was looked at is in ${work}`);
  process.exit(1);
}
console.log(`all pages are sound; they are in ${work}`);
