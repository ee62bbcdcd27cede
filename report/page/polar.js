// The chart of a roundness tester: deviations drawn outward from a reference circle, magnified.
import Plotly from './plotly.js';
import {onTheme, theme} from './theme.js';

const TURN = 2 * Math.PI;
const MM_PER_PIXEL = 25.4 / 96;  // of CSS, and of a page printed at 100 %

export function roundUp125(value) {
  const decade = 10 ** Math.floor(Math.log10(value) + 1e-9);
  return decade * [1, 2, 5, 10].find((factor) => value <= factor * decade * (1 + 1e-9));
}

// "0.02", "5": as many decimals as ticks of `step` need.
function tickText(value, step) {
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

// Splits points into runs around the axis: a new run begins at a gap or after a full turn.
function runsOf(angle, deviation) {
  const points = angle.map((a, k) => ({a, d: deviation[k]})).filter((p) => p.a !== null && p.d !== null);
  const step = (k) => {
    const s = (points[k].a - points[k - 1].a) % TURN;
    return s > Math.PI ? s - TURN : s < -Math.PI ? s + TURN : s;
  };
  const steps = points.slice(1).map((_, k) => Math.abs(step(k + 1))).sort((p, q) => p - q);
  const usual = steps[Math.floor(steps.length / 2)] || 0;
  const gap = Math.max(4 * usual, 0.02);
  const runs = [];
  let turned = 0;
  points.forEach((p, k) => {
    const s = k > 0 ? step(k) : Infinity;
    turned += Math.abs(s);
    if (Math.abs(s) > gap || turned > TURN - 0.5 * usual) {
      runs.push([]);
      turned = 0;
    }
    runs[runs.length - 1].push(p);
  });
  for (const run of runs) {
    const covered = usual * run.length;
    if (run.length > 2 && covered > TURN - 1.5 * usual) run.push(run[0]);
  }
  return runs;
}

function circle(radius, name, line) {
  const theta = Array.from({length: 181}, (_, k) => 2 * k);
  return {type: 'scatterpolar', mode: 'lines', r: theta.map(() => radius), theta, line,
          name, hoverinfo: 'skip'};
}

export function drawPolar(element, chart) {
  const runs = runsOf(chart.angle, chart.deviation_um);
  const all = runs.flat();
  if (all.length === 0) return;
  const top = all.reduce((m, p) => Math.max(m, p.d), -Infinity);
  const bottom = all.reduce((m, p) => Math.min(m, p.d), Infinity);
  const largest = Math.max(Math.abs(top), Math.abs(bottom), 1e-4);
  const division = roundUp125(largest / 3);
  const rings = Math.max(1, Math.ceil(largest / division - 1e-9));
  // The reference circle at six tenths of the chart; the rings take three tenths on either side.
  const reference = 2 * rings * division;
  const outer = reference + (rings + 0.35) * division;
  const theta = [];
  const r = [];
  const text = [];
  for (const run of runs) {
    for (const p of run) {
      theta.push(p.a * 180 / Math.PI);
      r.push(reference + p.d);
      text.push(`${(p.a * 180 / Math.PI).toFixed(1)}°  ${p.d.toFixed(3)} µm`);
    }
    theta.push(null);
    r.push(null);
    text.push('');
  }
  const ticks = Array.from({length: 2 * rings + 1}, (_, k) => (k - rings) * division);
  // Beside three rings there is room for the number of every other one.
  const tickLabel = (v, k) => rings > 2 && (k - rings) % 2 !== 0 ? '' :
      (v > 0 ? '+' : v < 0 ? '−' : '') + tickText(Math.abs(v), division);
  const scale = element.closest('figure').querySelector('.scale');

  onTheme(() => {
    const t = theme();
    const axis = {color: t.faint, gridcolor: t.rule, linecolor: t.rule, tickcolor: t.rule};
    const traces = [
      circle(reference, 'reference', {color: t.faint, width: 1.2, dash: 'dash'}),
      circle(reference + top, 'largest', {color: t.fail, width: 1, dash: 'dot'}),
      circle(reference + bottom, 'smallest', {color: t.fail, width: 1, dash: 'dot'}),
      {type: 'scatterpolar', mode: 'lines', r, theta, text, hoverinfo: 'text', connectgaps: false,
       line: {color: t.accent, width: runs.length > 1 ? 1.2 : 1.8}, name: 'deviation'},
    ];
    const layout = {
      autosize: true,
      showlegend: false,
      margin: {l: 44, r: 44, t: 26, b: 26},
      paper_bgcolor: 'rgba(0,0,0,0)',
      font: {family: t.font, size: 12, color: t.ink},
      polar: {
        bgcolor: 'rgba(0,0,0,0)',
        radialaxis: {...axis, range: [0, outer], angle: 15, tickangle: 15, showline: false,
                     ticks: '', tickvals: ticks.map((v) => reference + v),
                     ticktext: ticks.map(tickLabel),
                     tickfont: {size: 10, color: t.faint}},
        angularaxis: {...axis, rotation: 0, direction: 'counterclockwise', dtick: 30,
                      ticksuffix: '°', tickfont: {size: 11, color: t.faint}},
      },
    };
    Plotly.react(element, traces, layout, {displayModeBar: false, responsive: true}).then(() => {
      const radius = element._fullLayout.polar._subplot.radius;
      const magnification = radius * MM_PER_PIXEL / (outer / 1000);
      const digits = 10 ** Math.max(0, Math.floor(Math.log10(magnification)) - 1);
      scale.textContent = `peak to valley ${(top - bottom).toFixed(3)} µm · ${
          tickText(division, division)} µm per division · × ${
          (Math.round(magnification / digits) * digits).toLocaleString('en').replaceAll(',', ' ')}`;
    });
  });
}
