// The program that is played, as typed arrays, and the ways between times, points, blocks and NC lines.
//
// A point k > 0 is where the motion from point k - 1 ends; its block is the block of that motion.
import {unpack, unpackText} from '../page/packed_array.js';

const counts = (packed) => unpack(packed.data, packed.count, 1);

async function reals(packed, Type = Float32Array) {
  if (!packed) return new Type(0);
  const steps = await unpack(packed.data, packed.count, packed.stride);
  const values = new Type(packed.count);
  for (let k = 0, column = 0; k < steps.length; ++k) {
    values[k] = packed.origin[column] + steps[k] * packed.step;
    if (++column === packed.stride) column = 0;
  }
  return values;
}

export async function modelOf(data) {
  const {points, blocks} = data;
  const [times, tips, deviations, linear, rotary, reached, block, begins] = await Promise.all([
    reals(points.times, Float64Array), reals(points.tips), reals(points.deviations), reals(points.linear, Float64Array),
    reals(points.rotary, Float64Array), reals(points.feeds), counts(points.blocks), counts(points.starts),
  ]);
  const [lines, texts, tools, rapid, feeds, contents] = await Promise.all([
    counts(blocks.lines), counts(blocks.texts), counts(blocks.tools), counts(blocks.rapid), reals(blocks.feeds),
    Promise.all(data.texts.map((each) => unpackText(each.text))),
  ]);
  const count = points.count;
  const starts = new Uint8Array(count);
  begins.forEach((k) => starts[k] = 1);
  const model = {
    count, times, tips, deviations, linear, rotary, block, starts,
    reached,  // mm/min: of the tip along the motion that ends at each point
    blocks: {lines, texts, tools, rapid, feeds},
    texts: data.texts.map(({name}, k) => ({name, lines: contents[k].replace(/\r/g, '').replace(/\n$/, '').split('\n')})),
    duration: times[count - 1],
    begin: times[0],
  };
  model.ends = endsOfLines(model);
  return model;
}

// For each text, the lines that move the tool, ascending, and for each of them the points where its blocks end.
function endsOfLines({count, block, starts, blocks, texts}) {
  const ends = texts.map(() => new Map());
  for (let k = 1; k < count; ++k) {
    if (starts[k]) continue;
    if (k + 1 < count && block[k + 1] === block[k] && !starts[k + 1]) continue;
    const of = ends[blocks.texts[block[k]]], line = blocks.lines[block[k]];
    const known = of.get(line);
    known ? known.push(k) : of.set(line, [k]);
  }
  return ends.map((points) => ({points, lines: [...points.keys()].sort((a, b) => a - b)}));
}

// The first of sorted values that is at or above.
function firstAtOrAbove(values, value) {
  let low = 0, high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

// The point at which the motion that is under way at a time ends. `near`: where to look first.
export function pointAt(model, time, near) {
  const {times, count} = model;
  if (near > 0 && near < count && times[near - 1] < time) {
    if (time <= times[near]) return near;
    if (near + 1 < count && time <= times[near + 1]) return near + 1;
  }
  return Math.max(1, Math.min(count - 1, firstAtOrAbove(times, time)));
}

export function lineOfPoint(model, point) {
  const block = model.block[point];
  return {text: model.blocks.texts[block], line: model.blocks.lines[block]};
}

// The line itself where it moves the tool, else the nearest one that does: before it (way -1) or after it (way 1);
// where there is none on that side, on the other; null where no line of the text does.
export function lineWithMotion(model, line, text = 0, way = -1) {
  const {lines} = model.ends[text];
  const at = firstAtOrAbove(lines, line);
  if (lines[at] === line || (way > 0 && at < lines.length)) return lines[at];
  return lines[Math.max(at - 1, 0)] ?? null;
}

// Where a line of the program has been executed, as `frustum cut --until-line` stops after it: the end of its first
// pass, or of the next one seen from a point of that line; of a line without motion, that of the line before it.
export function pointOfLine(model, line, text = 0, from = -1) {
  const moving = lineWithMotion(model, line, text);
  if (moving === null) return null;
  const ends = model.ends[text].points.get(moving);
  if (from > 0) {
    const now = lineOfPoint(model, from), later = firstAtOrAbove(ends, from + 1);
    if (now.line === moving && now.text === text && later < ends.length) return {point: ends[later], line: moving};
  }
  return {point: ends[0], line: moving};
}

// The point at which a block ends, `way` blocks from that of a point.
export function blockBeside(model, point, way) {
  const {block, count} = model;
  let k = point;
  if (way > 0) {
    while (k + 1 < count && block[k + 1] === block[point]) ++k;
    if (k === point && k + 1 < count) {
      const next = block[++k];
      while (k + 1 < count && block[k + 1] === next) ++k;
    }
    return k;
  }
  while (k > 1 && block[k - 1] === block[point]) --k;
  return Math.max(1, k - 1);
}
