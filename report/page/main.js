// Turns what the report embedded: the workpiece, or the vectors of a volume. Tables and charts need no script.
import {drawSurface} from './surface.js';
import {drawVolume} from './volumetric.js';

const data = JSON.parse(document.getElementById('chart-data').textContent);
const view = document.querySelector('[data-surface]');
if (view && data.surface) {
  drawSurface(view, data.surface, data.words).catch((failure) => console.warn(`The workpiece cannot be turned: ${failure.message}`));
}
const volume = document.querySelector('[data-volume]');
if (volume && data.volume) drawVolume(volume, data.volume);
