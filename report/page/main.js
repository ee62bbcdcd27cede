// Draws the charts of the page from the data that the report embedded.
import {drawAxes} from './axes.js';
import {drawPolar} from './polar.js';
import {drawProfile} from './profile.js';
import {drawSurface} from './surface.js';
import {drawVolume} from './volumetric.js';

const data = JSON.parse(document.getElementById('chart-data').textContent);

for (const element of document.querySelectorAll('[data-polar]')) {
  drawPolar(element, data.polar[Number(element.dataset.polar)]);
}
for (const element of document.querySelectorAll('[data-profile]')) {
  drawProfile(element, data.profiles[Number(element.dataset.profile)]);
}
for (const element of document.querySelectorAll('[data-trace]')) {
  drawAxes(element, data.traces[Number(element.dataset.trace)]);
}
const view = document.querySelector('[data-surface]');
if (view && data.surface) {
  drawSurface(view, data.surface).catch((failure) => {
    view.textContent = `The workpiece cannot be drawn: ${failure.message}`;
    view.classList.add('missing');
  });
}
const volume = document.querySelector('[data-volume]');
if (volume && data.volume) drawVolume(volume, data.volume);
