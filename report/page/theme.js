// Colours of what is drawn by script, read from the style sheet, so that light and dark agree.

const dark = window.matchMedia('(prefers-color-scheme: dark)');
const listeners = [];

export function theme() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(name).trim();
  return {
    ink: read('--ink'),
    faint: read('--faint'),
    series: [1, 2, 3, 4, 5].map((k) => read(`--series-${k}`)),
  };
}

// Calls `draw` now and whenever the colours change.
export function onTheme(draw) {
  listeners.push(draw);
  draw();
}

dark.addEventListener('change', () => listeners.forEach((draw) => draw()));
