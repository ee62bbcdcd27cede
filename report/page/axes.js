// Where the axes are during an operation: linear axes on the left scale, rotary axes on the right.
import Plotly from './plotly.js';
import {onTheme, theme} from './theme.js';

export function drawAxes(element, trace) {
  const isCone = trace.abscissa_kind === 'cone_angle';
  const blocks = trace.abscissa.at(-1);
  const hasRotary = trace.axes.some((series) => series.rotary);
  const colourIndex = (k) => k % theme().series.length;
  const key = document.createElement('span');
  key.className = 'key';
  trace.axes.forEach((series, k) => {
    const entry = document.createElement('span');
    entry.textContent = series.axis;
    entry.className = series.rotary ? 'rotary' : 'linear';
    entry.style.setProperty('--line', `var(--series-${colourIndex(k) + 1})`);
    key.append(entry);
  });
  element.closest('figure').querySelector('figcaption').append(key);
  onTheme(() => {
    const t = theme();
    const axis = {color: t.faint, gridcolor: t.rule, zerolinecolor: t.rule, linecolor: t.rule,
                  showline: true, ticks: 'outside', ticklen: 4, tickcolor: t.rule, automargin: true};
    const title = (text) => ({text, font: {size: 12, color: t.faint}, standoff: 8});
    const traces = trace.axes.map((series, k) => ({
      type: 'scatter', mode: 'lines', name: series.axis, x: trace.abscissa, y: series.values,
      yaxis: series.rotary ? 'y2' : 'y',
      line: {color: t.series[colourIndex(k)], width: 1.8, simplify: false,
             dash: series.rotary ? 'dash' : 'solid'},
      hovertemplate: `%{y:.4f} ${series.rotary ? '°' : 'mm'}`,
    }));
    const layout = {
      autosize: true,
      margin: {l: 62, r: hasRotary ? 62 : 20, t: 14, b: 48},
      paper_bgcolor: 'rgba(0,0,0,0)',
      plot_bgcolor: 'rgba(0,0,0,0)',
      font: {family: t.font, size: 12, color: t.ink},
      hovermode: 'x unified',
      hoverlabel: {bgcolor: t.paper, font: {color: t.ink}},
      showlegend: false,
      xaxis: {...axis, title: title(isCone ? 'Cone angle φ, degrees' : 'Block'),
              ...(isCone ? {dtick: 45} : blocks <= 10 ? {dtick: 1} : {})},
      yaxis: {...axis, title: title('Linear axes, mm'), nticks: 7},
      yaxis2: {...axis, title: title('Rotary axes, degrees'), overlaying: 'y', side: 'right',
               showgrid: false, nticks: 7},
    };
    if (!hasRotary) delete layout.yaxis2;
    Plotly.react(element, traces, layout, {displayModeBar: false, responsive: true});
  });
}
