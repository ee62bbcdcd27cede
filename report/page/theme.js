// Colours and type of the charts, read from the style sheet, so that light, dark and print agree.

const dark = window.matchMedia('(prefers-color-scheme: dark)');
const listeners = [];

export function theme() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(name).trim();
  return {
    ink: read('--ink'),
    faint: read('--faint'),
    rule: read('--rule'),
    accent: read('--accent'),
    fail: read('--fail'),
    paper: read('--paper'),
    font: read('--sans'),
    series: [1, 2, 3, 4, 5].map((k) => read(`--series-${k}`)),
  };
}

// Calls `draw` now and whenever the colours change.
export function onTheme(draw) {
  listeners.push(draw);
  draw();
}

const redraw = () => listeners.forEach((draw) => draw());
dark.addEventListener('change', redraw);
// Paper is light whatever the screen is.
window.addEventListener('beforeprint', () => {
  document.documentElement.classList.add('paper');
  redraw();
});
window.addEventListener('afterprint', () => {
  document.documentElement.classList.remove('paper');
  redraw();
});
