// Two lines as measured: error across over the position along, with their least-squares straight lines.
import Plotly from './plotly.js';
import {onTheme, theme} from './theme.js';

const SYMBOLS = ['circle', 'square-open'];  // distinct without colours, too

// The straight line over the positions that were measured, and 4 % beyond.
function fitted(line) {
  const places = line.position_mm.filter((p) => p !== null);
  if (places.length === 0 || line.fit_offset_um === null || line.fit_slope_urad === null) {
    return {x: [], y: []};
  }
  const low = places.reduce((m, p) => Math.min(m, p), Infinity);
  const high = places.reduce((m, p) => Math.max(m, p), -Infinity);
  const x = [low - 0.04 * (high - low), high + 0.04 * (high - low)];
  return {x, y: x.map((p) => line.fit_offset_um + line.fit_slope_urad * 1e-3 * p)};
}

export function drawProfile(element, chart) {
  const key = document.createElement('span');
  key.className = 'key';
  chart.lines.forEach((line, k) => {
    const entry = document.createElement('span');
    entry.textContent = line.feature;
    entry.className = k % 2 ? 'second' : 'first';
    entry.style.setProperty('--line', `var(--series-${k % 2 + 1})`);
    key.append(entry);
  });
  element.closest('figure').querySelector('figcaption').append(key);
  onTheme(() => {
    const t = theme();
    const axis = {color: t.faint, gridcolor: t.rule, zerolinecolor: t.faint, zerolinewidth: 1,
                  linecolor: t.rule, showline: true, ticks: 'outside', ticklen: 4,
                  tickcolor: t.rule, nticks: 6, automargin: true};
    const title = (text) => ({text, font: {size: 11, color: t.faint}, standoff: 6});
    const traces = chart.lines.flatMap((line, k) => {
      const colour = t.series[k % 2];
      const fit = fitted(line);
      return [
        {type: 'scatter', mode: 'markers', x: line.position_mm, y: line.deviation_um,
         name: line.feature, marker: {color: colour, size: 5.5, symbol: SYMBOLS[k % 2]},
         hovertemplate: '%{x:.2f} mm, %{y:.3f} µm<extra></extra>'},
        {type: 'scatter', mode: 'lines', ...fit, hoverinfo: 'skip', name: line.feature,
         line: {color: colour, width: 1.4, dash: 'dash'}},
      ];
    });
    const layout = {
      autosize: true,
      margin: {l: 46, r: 8, t: 8, b: 38},
      paper_bgcolor: 'rgba(0,0,0,0)',
      plot_bgcolor: 'rgba(0,0,0,0)',
      font: {family: t.font, size: 11, color: t.ink},
      hovermode: 'closest',
      hoverlabel: {bgcolor: t.paper, font: {color: t.ink}},
      showlegend: false,
      xaxis: {...axis, title: title('Position along, mm')},
      // Errors of a few nanometres do not look like errors: at least 0.1 um is shown.
      yaxis: {...axis, title: title('Error across, µm'), ...range(chart)},
    };
    Plotly.react(element, traces, layout, {displayModeBar: false, responsive: true});
  });
}

function range(chart) {
  const all = chart.lines.flatMap((line) => [...line.deviation_um, ...fitted(line).y])
                  .filter((d) => d !== null);
  const low = all.reduce((m, d) => Math.min(m, d), 0);
  const high = all.reduce((m, d) => Math.max(m, d), 0);
  const room = Math.max(0.06 * (high - low), 0.5 * (0.1 - (high - low)));
  return {range: [low - room, high + room]};
}
