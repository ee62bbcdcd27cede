// The program player as a person uses it: NC line to point and back, by calls, by the mouse, by the keys alone; what is
// drawn of path and machine agrees with what was computed.
//
// `about` has browser, expect and settled of pages_test.mjs.

const view = 'window.frustumView';

async function press(browser, key, {code = key, shift = false} = {}) {
  const text = key.length === 1 ? key : key === 'Enter' ? '\r' : undefined;
  const virtual = {Tab: 9, Enter: 13, ArrowDown: 40, ArrowUp: 38, ArrowRight: 39, ArrowLeft: 37, End: 35, Home: 36}[key];
  const modifiers = shift ? 8 : 0;
  await browser.send('Input.dispatchKeyEvent',
                     {type: 'keyDown', key, code, text, modifiers, windowsVirtualKeyCode: virtual});
  await browser.send('Input.dispatchKeyEvent', {type: 'keyUp', key, code, modifiers, windowsVirtualKeyCode: virtual});
}

// Every line that moves the tool leads to a point, and that point to the line.
async function checkRoundTrip({browser, expect}, page) {
  const lost = await browser.evaluate(`(() => {
    const lost = [];
    for (const [k, line] of ${view}.linesWithMotion().entries()) {
      const {point} = ${view}.pointOfLine(line);
      if (${view}.lineOfPoint(point).line !== line) lost.push(line);
      if (k % 10 > 0) continue;
      ${view}.seekPoint(point);
      if (${view}.lineOfPoint(${view}.point).line !== line) lost.push(line);
    }
    return lost;
  })()`);
  expect(lost.length === 0, page, `lines that do not come back: ${lost.slice(0, 5)}`);
  const lines = await browser.evaluate(`${view}.linesWithMotion().length`);
  expect(lines > 10, page, `${lines} lines with motion`);
}

// A click on a point of the path goes to the line of that point; only points that nothing else is drawn over.
async function checkClicks({browser, expect}, page) {
  const places = await browser.evaluate(`(() => {
    ${view}.seek(0);  // where the workpiece is then
    document.querySelector('.view').scrollIntoView({block: 'center'});
    const places = [];
    const lines = ${view}.linesWithMotion();
    for (let k = 1; k < 12; ++k) {
      const line = lines[Math.floor(lines.length * k / 12)];
      const {point} = ${view}.pointOfLine(line);
      const {x, y} = ${view}.placeOfPoint(point);
      const found = ${view}.pickAt(x, y);
      const other = found && ${view}.placeOfPoint(found.point);
      places.push({line, x, y, found: found && ${view}.lineOfPoint(found.point).line,
                   apart: other ? Math.hypot(other.x - x, other.y - y) : null});
    }
    return places;
  })()`);
  // Of passes that are drawn over each other the click takes that in front.
  const clear = places.filter(({line, found}) => found !== null && Math.abs(found - line) <= 1);
  expect(places.every(({found}) => found !== null), page, 'a point of the path is not found where it is drawn');
  expect(clear.length >= 3, page, `${clear.length} of ${places.length} points are found by their own lines`);
  for (const {x, y, found} of clear.slice(0, 3)) {
    await browser.evaluate(`${view}.seek(0)`);
    for (const type of ['mousePressed', 'mouseReleased']) {
      await browser.send('Input.dispatchMouseEvent', {type, x: Math.round(x), y: Math.round(y), button: 'left', clickCount: 1});
    }
    const {line, listed} = await browser.evaluate(`({
      line: ${view}.lineOfPoint(${view}.point).line,
      listed: Number(document.querySelector('.listing [aria-selected="true"]')?.dataset.line),
    })`);
    expect(Math.abs(line - found) <= 1, page, `a click on line ${found} goes to line ${line}`);
    expect(listed === line, page, `the list shows line ${listed}, the path line ${line}`);
  }
}

// From the begin of the page to playing, a line and a colouring, without a mouse.
async function checkKeysAlone({browser, expect, settled}, page) {
  await browser.evaluate(`(() => {
    ${view}.seek(0);
    document.activeElement?.blur();
    window.getSelection().removeAllRanges();
    document.querySelector('h1').scrollIntoView();
  })()`);
  const focus = () => browser.evaluate(`(() => {
    const e = document.activeElement;
    return e.getAttribute('aria-label') ?? e.closest('label')?.textContent.trim().split(/\\s/)[0] ?? e.id ?? e.textContent;
  })()`);
  const order = [];
  for (let k = 0; k < 30; ++k) {
    await press(browser, 'Tab');
    const name = await browser.evaluate('document.activeElement.matches("[data-listing]") ? "listing" : document.activeElement.matches(".view") ? "view" : document.activeElement.matches("[data-play]") ? "play" : document.activeElement.matches("[data-scrub]") ? "scrub" : document.activeElement.matches("#jump-line") ? "jump" : ""');
    if (name) order.push(name);
    if (name === 'listing') break;
  }
  expect(order.join() === 'view,play,scrub,jump,listing', page, `Tab goes to ${order.join()} (${await focus()})`);
  const line = () => browser.evaluate(`${view}.lineOfPoint(${view}.point).line`);
  // In the list: down goes on, with motion.
  const first = await line();
  await press(browser, 'ArrowDown');
  const second = await line();
  expect(second > first, page, `down from line ${first} is line ${second}`);
  await press(browser, 'ArrowUp');
  expect(await line() < second, page, `up from line ${second} is line ${await line()}`);
  // A line by its number.
  await press(browser, 'l', {code: 'KeyL'});
  const lines = await browser.evaluate(`${view}.linesWithMotion()`);
  const wanted = lines[Math.floor(lines.length / 2)];
  for (const digit of String(wanted)) await press(browser, digit);
  await press(browser, 'Enter');
  expect(await line() === wanted, page, `line ${wanted} by its number is line ${await line()}`);
  // Play, slower, pause.
  await press(browser, 'v', {code: 'KeyV'});
  await browser.evaluate(`document.querySelector('.view').focus()`);
  await press(browser, 'v', {code: 'KeyV'});
  const before = await browser.evaluate(`${view}.time`);
  await press(browser, ' ', {code: 'Space'});
  expect(await browser.evaluate(`${view}.playing`), page, 'the space bar does not play');
  const time = await settled(() => browser.evaluate(`${view}.time`), (now) => now > before);
  expect(time > before, page, 'time does not go on');
  await press(browser, ' ', {code: 'Space'});
  expect(!(await browser.evaluate(`${view}.playing`)), page, 'the space bar does not pause');
  const colour = () => browser.evaluate(`document.querySelector('[data-colour]').value + ' ' +
      document.querySelector('.legend b').textContent`);
  const shown = [await colour()];
  const most = await browser.evaluate(`document.querySelector('.legend .strip span').textContent`);
  expect(most === '500', page, `the scale of feeds ends at ${most} mm/min, 500 are programmed`);
  for (let k = 0; k < 2; ++k) {
    await press(browser, 'c', {code: 'KeyC'});
    shown.push(await colour());
  }
  expect(/^feed mm\/min,deviation (µm|nm),time (s|min)$/.test(shown.join()), page, `colourings: ${shown.join()}`);
  await press(browser, 'c', {code: 'KeyC'});
  await press(browser, 'd', {code: 'KeyD'});
  const magnified = await browser.evaluate(`document.querySelector('[data-magnified]').textContent`);
  expect(magnified === '10', page, `deviations are magnified ${magnified} times`);
  await press(browser, 'D', {code: 'KeyD', shift: true});
  await press(browser, 'End');
  expect(await browser.evaluate(`${view}.time === ${view}.duration`), page, 'End is not the end of the program');
}

export async function checkPlayer(about, page) {
  const {browser, expect, settled} = about;
  await settled(() => browser.evaluate(`typeof ${view}`), (kind) => kind === 'object');
  await checkRoundTrip(about, page);
  await checkClicks(about, page);
  await checkKeysAlone(about, page);
  // The axes, by the page's own chain of joints, hold the tip where the program computed it.
  const error = await browser.evaluate(`${view}.axesError()`);
  expect(error < 5e-3, page, `the axes put the tip ${error} mm off the path`);
  await browser.evaluate(`${view}.seek(${view}.duration * 0.6)`);
}
