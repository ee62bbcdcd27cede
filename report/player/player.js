// Plays a program: the state at a time, what is drawn of it, and window.frustumView, by which scripts and tests ask
// the page what a person does with mouse and keys:
//
//   duration, time, point, playing          s, s, index, whether it plays
//   lineOfPoint(point)                      {text, line} of the motion that ends there
//   pointOfLine(line, text, from)           {point, line} where it has been executed; of the pass after `from`; or null
//   seek(seconds), seekPoint(point), play(), pause()
//   drawAt(seconds)                         what a frame does, without the numbers and the list beside
//   placeOfPoint(point)                     {x, y} in the window, px
//   pickAt(x, y)                            {point, share} of the motion that is drawn there; or null
//   axesError()                             mm: the largest distance of a tip from where the axes put it
//   pixelShare                              of the pixels, in each direction, that a moving picture is drawn with
//   frameTimes(), clearFrameTimes()         of the frames that were played (frame_times.js)
import * as three from 'three';
import {onTheme, theme} from '../page/theme.js';
import {addLights} from '../page/surface.js';
import {viewIn} from '../page/view.js';
import {Controls} from './controls.js';
import {FrameTimes} from './frame_times.js';
import {Machine, materials, meshGeometry} from './machine.js';
import {blockBeside, lineOfPoint, modelOf, pointAt, pointOfLine} from './model.js';
import {Path} from './path.js';
import {Resolution} from './resolution.js';

const REACH = 10;       // px within which a click finds the path
const PANEL_MS = 100;   // between two changes of numbers and listing while it plays
const MARGIN = {part: 1.2, machine: 1.05};

class Player {
  constructor(element, model, machine, steps, view, tools) {
    this.element = element;
    this.tools = tools;
    this.model = model;
    this.machine = machine;
    this.view = view;
    this.path = new Path(model);
    this.steps = steps;
    this.time = model.begin;
    this.point = 1;
    this.playing = false;
    this.speed = 1;
    this.holds = 'machine';
    this.frames = new FrameTimes();
    this.resolution = new Resolution();
    this.linear = new Float64Array(machine.linearCount);
    this.rotary = new Float64Array(machine.rotaryCount);
    this.tip = new Float64Array(3);
    this.deviation = new Float64Array(3);
    machine.workpiece.add(this.path.group);
    for (const {mesh} of steps) {
      if (!mesh) continue;
      mesh.visible = false;
      machine.workpiece.add(mesh);
    }
    view.scene.add(machine.root);
    this.step = null;
    this.showsPart = true;
    this.lastFrame = 0;
    this.lastPanel = 0;
    this.isDue = false;
    this.frame = this.frame.bind(this);
    this.controls = new Controls(this);
  }

  // Puts everything where it is when `share` of the way to a point is done.
  set(point, share) {
    const {model, machine, linear, rotary, tip, deviation} = this;
    this.point = point;
    const from = model.starts[point] && share === 1 ? point : point - 1;
    const mix = (values, stride, into) => {
      for (let i = 0; i < stride; ++i) {
        const a = values[from * stride + i];
        into[i] = a + share * (values[point * stride + i] - a);
      }
    };
    mix(model.linear, linear.length, linear);
    mix(model.rotary, rotary.length, rotary);
    mix(model.tips, 3, tip);
    mix(model.deviations, 3, deviation);
    const magnify = this.path.magnify.value;
    const x = tip[0] + magnify * deviation[0], y = tip[1] + magnify * deviation[1], z = tip[2] + magnify * deviation[2];
    machine.pose(linear, rotary);
    machine.placeTool(x, y, z);
    machine.showTool(model.blocks.tools[model.block[point]]);
    machine.hold(this.holds);
    this.path.showTo(point, x, y, z);
    this.showStep();
  }

  showStep() {
    let now = null;
    if (this.showsPart) {
      for (const step of this.steps) {
        if (step.time <= this.time + 1e-6 || now === null) now = step;
      }
    }
    if (now === this.step) return;
    if (this.step?.mesh) this.step.mesh.visible = false;
    if (now?.mesh) now.mesh.visible = true;
    this.step = now;
  }

  at(time) {
    const {model} = this;
    this.time = Math.min(Math.max(time, model.begin), model.duration);
    const point = pointAt(model, this.time, this.point);
    const begin = model.times[point - 1], seconds = model.times[point] - begin;
    this.set(point, seconds > 0 ? Math.min(Math.max((this.time - begin) / seconds, 0), 1) : 1);
  }

  // With the next frame of the screen: a hand on the time line asks more often than a slow computer draws.
  drawSoon() {
    if (this.isDue || this.playing) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.view.render();
    });
  }
  redraw() {
    this.drawSoon();
    this.controls.show();
  }
  seek(time) {
    this.at(time);
    this.redraw();
  }
  seekPoint(point, share = 1) {
    const {times} = this.model;
    this.time = times[point - 1] + share * (times[point] - times[point - 1]);
    this.set(point, share);
    this.redraw();
  }
  // What is drawn has changed, not the time.
  again() {
    const {times} = this.model;
    const seconds = times[this.point] - times[this.point - 1];
    this.set(this.point, seconds > 0 ? (this.time - times[this.point - 1]) / seconds : 1);
    this.drawSoon();
  }
  stepBlock(way) {
    this.pause();
    this.seekPoint(blockBeside(this.model, this.point, way));
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.model.duration) this.at(this.model.begin);
    this.playing = true;
    this.lastFrame = 0;
    this.move(true);
    this.controls.show();
    requestAnimationFrame(this.frame);
  }
  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.move(false);
    this.redraw();
  }
  // A picture that moves is drawn with less, so that it moves smoothly.
  move(isMoving) {
    this.path.brief(isMoving);
    this.view.drawAtShare(isMoving ? this.resolution.share : 1);
  }

  frame(now) {
    if (!this.playing) return;
    const begin = performance.now();
    const interval = this.lastFrame > 0 ? now - this.lastFrame : 0;
    this.lastFrame = now;
    this.at(this.time + interval / 1000 * this.speed);
    if (this.time >= this.model.duration) {
      this.playing = false;
      this.move(false);
    }
    if (now - this.lastPanel >= PANEL_MS || !this.playing) {
      this.lastPanel = now;
      this.controls.show();
    }
    const updated = performance.now();
    this.view.render();
    if (interval > 0) {
      this.frames.add(updated - begin, performance.now() - updated, interval);
      if (this.playing && this.resolution.add(interval)) this.view.drawAtShare(this.resolution.share);
    }
    if (this.playing) requestAnimationFrame(this.frame);
  }

  // The workpiece with the path, in its own frame; without rapids, which go high above it.
  ownBox() {
    const {tips, count, blocks, block} = this.model;
    const box = new three.Box3(), place = new three.Vector3();
    const extend = (takes) => {
      for (let k = 0; k < count; ++k) {
        if (takes(k)) box.expandByPoint(place.fromArray(tips, 3 * k));
      }
    };
    extend((k) => !blocks.rapid[block[k]]);
    if (box.isEmpty()) extend(() => true);
    for (const {mesh} of this.steps) {
      if (!mesh) continue;
      mesh.geometry.computeBoundingBox();
      box.union(mesh.geometry.boundingBox);
    }
    return box;
  }
  // What the camera looks at: the machine as it is now, or the workpiece wherever it goes.
  boxOf(what) {
    const {machine, model} = this, box = new three.Box3();
    if (what === 'machine') {
      machine.root.updateMatrixWorld(true);
      return box.setFromObject(machine.root);
    }
    const own = this.ownBox(), there = new three.Box3();
    const parts = 64;  // of the program, at which it is looked where the workpiece is
    const {point, time} = this;
    for (let k = 0; k <= parts; ++k) {
      this.set(1 + Math.round((model.count - 2) * k / parts), 1);
      machine.root.updateMatrixWorld(true);
      box.union(there.copy(own).applyMatrix4(machine.workpiece.matrixWorld));
    }
    this.time = time;
    this.point = point;
    this.again();
    return box;
  }
  toolTitle(number) {
    const tool = this.tools.find((each) => each.number === number);
    return tool ? `${number}: ${tool.title}` : String(number);
  }
  fit(what) { this.view.fit(this.boxOf(what), MARGIN[what]); }

  pickAt(x, y, reach = REACH) {
    this.view.scene.updateMatrixWorld();
    const box = this.view.canvas.getBoundingClientRect();
    return this.path.pick(this.view.camera, box.width, box.height, x - box.left, y - box.top, reach);
  }
  placeOfPoint(point) {
    this.view.scene.updateMatrixWorld();
    const box = this.view.canvas.getBoundingClientRect();
    const {x, y} = this.path.placeOf(point, this.view.camera, box.width, box.height);
    return {x: x + box.left, y: y + box.top};
  }

  // Holds the axes of every point against its tip.
  axesError() {
    const {model, machine, linear, rotary, tools} = this;
    const tip = new three.Vector3();
    let largest = 0;
    for (let k = 0; k < model.count; ++k) {
      linear.forEach((_, i) => linear[i] = model.linear[k * linear.length + i]);
      rotary.forEach((_, i) => rotary[i] = model.rotary[k * rotary.length + i]);
      machine.pose(linear, rotary);
      const {length} = tools.find(({number}) => number === model.blocks.tools[model.block[k]]);
      machine.tipOfAxes(length, tip);
      const i = 3 * k;
      largest = Math.max(largest, Math.hypot(tip.x - model.tips[i], tip.y - model.tips[i + 1], tip.z - model.tips[i + 2]));
    }
    this.again();
    return largest;
  }
}

// A click that is no turn of the view goes to the motion under it.
function listenToClicks(player) {
  let pressed = null;
  const {canvas} = player.view;
  canvas.addEventListener('pointerdown', (event) => pressed = [event.clientX, event.clientY]);
  canvas.addEventListener('pointerup', (event) => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 3) return;
    const reach = event.pointerType === 'touch' ? 2 * REACH : REACH;
    const found = player.pickAt(event.clientX, event.clientY, reach);
    if (!found) return;
    player.pause();
    player.seekPoint(found.point, found.share);
    player.controls.say();
  });
}

// While the view turns it is drawn with less, too.
function listenToTurns(player) {
  const {controls, render} = player.view;
  controls.addEventListener('start', () => player.move(true));
  controls.addEventListener('end', () => {
    if (player.playing) return;
    player.move(false);
    render();
  });
}

function colourBodies(player) {
  onTheme(() => {
    const {faint, ink} = theme();
    const isDark = window.matchMedia('(prefers-color-scheme: dark)').matches;
    for (const body of [materials.machine, materials.glass]) body.color.set(isDark ? '#6d7c8c' : '#8795a4');
    materials.fixture.color.set(isDark ? '#9a7b4a' : '#b8935a');
    materials.cutter.color.set('#d9a83a');
    materials.shank.color.set('#8f979f');
    materials.holder.color.set(isDark ? '#727a83' : '#5c646d');
    materials.part.color.set(isDark ? '#b3bcc6' : '#c3cad2');
    materials.edges.color.set(faint);
    player.path.setInk(ink);
    player.view.render();
  });
}

// Without a graphics card smooth edges would cost half of each frame.
function drawsOnProcessor() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const named = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = named ? String(gl.getParameter(named.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

function publish(player) {
  const {model, view} = player;
  window.frustumView = {
    get duration() { return model.duration; },
    get time() { return player.time; },
    get point() { return player.point; },
    get points() { return model.count; },
    get segmentsInMotion() { return player.path.drawnBriefly; },
    get playing() { return player.playing; },
    linesWithMotion: (text = 0) => model.ends[text].lines,
    lineOfPoint: (point) => lineOfPoint(model, point),
    pointOfLine: (line, text = 0, from = -1) => pointOfLine(model, line, text, from),
    seek: (seconds) => player.seek(seconds),
    seekPoint: (point, share) => player.seekPoint(point, share),
    drawAt: (seconds) => {
      player.path.brief(true);
      player.at(seconds);
      view.render();
    },
    play: () => player.play(),
    pause: () => player.pause(),
    placeOfPoint: (point) => player.placeOfPoint(point),
    pickAt: (x, y) => player.pickAt(x, y),
    axesError: () => player.axesError(),
    get pixelShare() { return player.resolution.share; },
    frameTimes: () => player.frames.summary,
    clearFrameTimes: () => player.frames.clear(),
  };
}

export async function playProgram(element, data) {
  const view = viewIn(element.querySelector('.view'), {antialias: !drawsOnProcessor()});
  if (!view) return;
  const [model, machine] = await Promise.all([modelOf(data), Machine.of(data.machine, data.tools)]);
  const steps = await Promise.all(data.steps.map(async ({time, mesh}) => {
    if (!mesh) return {time, mesh: null};
    const made = new three.Mesh(await meshGeometry(mesh), materials.part);
    return {time, mesh: made};
  }));
  addLights(view.scene, view.camera);
  const player = new Player(element, model, machine, steps, view, data.tools);
  element.classList.add('live');
  player.at(model.begin);
  listenToClicks(player);
  listenToTurns(player);
  view.show(player.boxOf('part'), MARGIN.part);
  colourBodies(player);
  player.redraw();
  publish(player);
}
