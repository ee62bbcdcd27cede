// The controls of the player and what it says: buttons, time line, colouring, the listing, numbers, keys.
import {Listing} from './listing.js';
import {lineOfPoint, lineWithMotion, pointOfLine} from './model.js';
import {rapidColour, scaleColours} from './path.js';

const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 25, 50, 100, 250, 1000];
const WATCHED = 90;  // s that a whole program takes at first, at most

const signed = (value, digits) => {
  const text = Math.abs(value).toFixed(digits);
  return `${value < 0 && Number(text) !== 0 ? '−' : ''}${text}`;
};
const list = (values, digits) => [...values].map((value) => signed(value, digits)).join('  ');

export class Controls {
  #player;
  #listing;
  #scrub;
  #time;
  #play;
  #status;
  #read = {};
  #selects = {};
  #point = -1;
  #pressed = null;
  #letters;

  constructor(player) {
    this.#player = player;
    const {element, model} = player;
    const find = (selector) => element.querySelector(selector);
    this.#letters = player.machine.letters;
    this.#scrub = find('[data-scrub]');
    this.#time = find('[data-clock]');
    this.#play = find('[data-play]');
    this.#status = find('[data-status]');
    for (const cell of element.querySelectorAll('[data-read]')) this.#read[cell.dataset.read] = cell;
    for (const name of ['colour', 'machine', 'hold', 'speed', 'text']) this.#selects[name] = find(`[data-${name}]`);
    this.#listing = new Listing(find('[data-listing]'), (line, way) => this.#goTo(line, way));
    this.#open(0);
    find('#jump-line').max = model.texts[0].lines.length;
    this.#scrub.min = model.begin;
    this.#scrub.max = model.duration;
    this.#fillSpeeds();
    this.#listenToControls(find);
    element.addEventListener('keydown', (event) => this.#key(event));
    this.colour('feed');
    this.#bodies('translucent');
  }

  #fillSpeeds() {
    const {model} = this.#player;
    const first = SPEEDS.find((speed) => (model.duration - model.begin) / speed <= WATCHED) ?? SPEEDS.at(-1);
    for (const speed of SPEEDS) {
      const option = document.createElement('option');
      option.value = speed;
      option.textContent = `× ${speed}`;
      this.#selects.speed.append(option);
    }
    this.#setSpeed(Math.max(first, 1));
  }
  #setSpeed(speed) {
    this.#player.speed = speed;
    this.#selects.speed.value = String(speed);
  }

  #listenToControls(find) {
    const player = this.#player, {element} = player, {colour, machine, hold, speed, text} = this.#selects;
    this.#play.addEventListener('click', () => this.#toggle());
    for (const button of element.querySelectorAll('[data-block]')) {
      button.addEventListener('click', () => player.stepBlock(Number(button.dataset.block)));
    }
    this.#scrub.addEventListener('input', () => {
      player.pause();
      player.seek(Number(this.#scrub.value));
    });
    speed.addEventListener('change', () => player.speed = Number(speed.value));
    colour.addEventListener('change', () => this.colour(colour.value));
    machine?.addEventListener('change', () => this.#bodies(machine.value));
    hold.addEventListener('change', () => {
      player.holds = hold.value;
      player.again();
      player.fit('part');
    });
    find('[data-magnify]').addEventListener('input', () => this.#magnify());
    find('[data-part]')?.addEventListener('change', (event) => {
      player.showsPart = event.target.checked;
      player.again();
    });
    for (const button of element.querySelectorAll('[data-fit]')) {
      button.addEventListener('click', () => player.fit(button.dataset.fit));
    }
    text?.addEventListener('change', () => {
      this.#open(Number(text.value));
      find('#jump-line').max = player.model.texts[this.#listing.text].lines.length;
    });
    find('[data-jump]').addEventListener('submit', (event) => {
      event.preventDefault();
      this.#goTo(Number(find('#jump-line').value));
    });
  }

  #open(text) {
    const {model} = this.#player;
    this.#listing.open(text, model.texts[text].lines, new Set(model.ends[text].lines));
    if (this.#selects.text) this.#selects.text.value = String(text);
  }

  // To the end of a line, or of its next pass. `way`: where a line without motion leads to, as lineWithMotion().
  #goTo(line, way = -1) {
    const player = this.#player, {text} = this.#listing, {model} = player;
    const wanted = lineWithMotion(model, line, text, way);
    if (wanted === null) {
      this.#status.textContent = `No line of ${model.texts[text].name} moves the tool.`;
      return;
    }
    const found = pointOfLine(model, wanted, text, player.point);
    player.pause();
    player.seekPoint(found.point);
    this.say(found.line === line ? '' : `Line ${line} moves no tool.`);
  }

  // To people who do not see it.
  say(before = '') {
    const {model, point} = this.#player, {text, line} = lineOfPoint(model, point);
    const words = `Line ${line}: ${model.texts[text].lines[line - 1] ?? ''}`;
    this.#status.textContent = `${before} ${words}`.trim();
  }

  #toggle() {
    const player = this.#player;
    player.playing ? player.pause() : player.play();
    if (!player.playing) this.say();
  }

  colour(kind) {
    const player = this.#player, legend = player.element.querySelector('.legend');
    const shown = player.path.colour(kind);
    this.#selects.colour.value = kind;
    const heading = document.createElement('b'), strip = document.createElement('div');
    heading.textContent = shown.unit;
    strip.className = 'strip';
    strip.style.background = `linear-gradient(to top, ${scaleColours().join(', ')})`;
    for (const share of [1, 0.75, 0.5, 0.25, 0]) {
      const label = document.createElement('span');
      label.textContent = Number((share * shown.limit * shown.factor).toPrecision(4)).toLocaleString('en');
      label.style.top = `${100 * (1 - share)}%`;
      strip.append(label);
    }
    legend.replaceChildren(heading, strip);
    const remark = document.createElement('p');
    if (kind === 'feed') {
      const mark = document.createElement('i');
      mark.style.background = rapidColour();
      remark.append(mark, 'rapid');
    } else if (shown.none) {
      remark.textContent = 'no deviation';
    }
    if (remark.textContent) legend.append(remark);
    legend.hidden = false;
    player.drawSoon();
  }

  #bodies(how) {
    const player = this.#player;
    if (this.#selects.machine) this.#selects.machine.value = how;
    player.machine.drawBodies(how);
    player.drawSoon();
  }

  // From 1 to a million times, in steps of 1, 2 and 5.
  #magnify() {
    const player = this.#player;
    const slider = player.element.querySelector('[data-magnify]');
    const power = Math.floor(Number(slider.value)), part = Number(slider.value) - power;
    const factor = 10 ** power * (part < 0.15 ? 1 : part < 0.5 ? 2 : part < 0.85 ? 5 : 10);
    player.path.magnify.value = factor;
    const words = factor.toLocaleString('en');
    player.element.querySelector('[data-magnified]').textContent = words;
    slider.setAttribute('aria-valuetext', `${words} times`);
    player.again();
  }

  // Numbers, time line and listing for where the program is.
  show() {
    const player = this.#player, {model, point} = player;
    const block = model.block[point], {text, line} = lineOfPoint(model, point);
    const total = model.duration.toFixed(1), now = player.time.toFixed(1);
    this.#scrub.value = player.time;
    this.#scrub.setAttribute('aria-valuetext', `${now} s of ${total} s, line ${line}`);
    this.#time.textContent = `${now} / ${total} s`;
    if (this.#pressed !== player.playing) {
      this.#pressed = player.playing;
      this.#play.textContent = player.playing ? 'Pause' : 'Play';
    }
    if (text !== this.#listing.text) this.#open(text);
    this.#listing.show(line);
    const read = this.#read;
    if (point !== this.#point) {
      this.#point = point;
      const name = model.texts.length > 1 ? `${model.texts[text].name}: ` : '';
      read.line.textContent = `${name}${line}`;
      read.tool.textContent = player.toolTitle(model.blocks.tools[block]);
      const programmed = model.blocks.feeds[block];
      read.programmed.textContent = model.blocks.rapid[block] ? 'rapid' : programmed.toFixed(1);
      read.reached.textContent = model.reached[point].toFixed(1);
    }
    read.tip.textContent = list(player.tip, 4);
    read.axes.textContent = this.#letters.map(({letter, rotary, column}) => rotary
        ? `${letter} ${signed(player.rotary[column] * 180 / Math.PI, 4)}°`
        : `${letter} ${signed(player.linear[column], 4)}`).join('  ');
    const micrometres = [...player.deviation].map((d) => 1000 * d);
    read.deviation.textContent = list(micrometres, 3);
    read.size.textContent = Math.hypot(...micrometres).toFixed(3);
  }

  // Keys that the focused control does not use itself.
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const {target, key} = event, player = this.#player;
    const isField = target.matches('input[type="number"], select');
    const isButton = target.matches('button, input[type="checkbox"]');
    if (isField) return;
    const inView = target.matches('.view');
    const actions = {
      'k': () => this.#toggle(),
      ',': () => player.stepBlock(-1),
      '.': () => player.stepBlock(1),
      '[': () => this.#changeSpeed(-1),
      ']': () => this.#changeSpeed(1),
      'l': () => player.element.querySelector('#jump-line').focus(),
      'p': () => player.element.querySelector('[data-listing]').focus(),
      'v': () => player.element.querySelector('.view').focus(),
      'c': () => this.#next(this.#selects.colour),
      'm': () => this.#selects.machine && this.#next(this.#selects.machine),
      'd': () => this.#changeMagnification(event.shiftKey ? -1 : 1),
    };
    if (!isButton) actions[' '] = () => this.#toggle();
    if (inView || isButton) {
      actions.Home = () => player.seek(player.model.begin);
      actions.End = () => player.seek(player.model.duration);
    }
    const action = actions[key.length === 1 ? key.toLowerCase() : key];
    if (!action) return;
    event.preventDefault();
    action();
  }
  #changeSpeed(way) {
    const k = SPEEDS.indexOf(this.#player.speed) + way;
    if (k < 0 || k >= SPEEDS.length) return;
    this.#setSpeed(SPEEDS[k]);
    this.#status.textContent = `Speed ${SPEEDS[k]} times`;
  }
  #next(select) {
    select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
    select.dispatchEvent(new Event('change'));
    this.#status.textContent = `${select.closest('label').firstChild.textContent.trim()}: ${select.selectedOptions[0].textContent}`;
  }
  #changeMagnification(way) {
    const slider = this.#player.element.querySelector('[data-magnify]');
    slider.value = Math.min(6, Math.max(0, Math.round(Number(slider.value)) + way));
    slider.dispatchEvent(new Event('input'));
    this.#status.textContent = `Deviations drawn ${slider.getAttribute('aria-valuetext')}`;
  }
}
