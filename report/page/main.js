// Turns what the report embedded: the workpiece, the vectors of a volume, a program that plays. Tables and charts
// need no script.
import {playProgram} from '../player/player.js';
import {drawSurface} from './surface.js';
import {drawVolume} from './volumetric.js';

const data = JSON.parse(document.getElementById('chart-data').textContent);
const view = document.querySelector('[data-surface]');
if (view && data.surface) {
  drawSurface(view, data.surface, data.words).catch((failure) => console.warn(`The workpiece cannot be turned: ${failure.message}`));
}
const volume = document.querySelector('[data-volume]');
if (volume && data.volume) drawVolume(volume, data.volume);
const player = document.querySelector('[data-player]');
if (player && data.player) {
  playProgram(player, data.player).catch((failure) => console.warn(`The program cannot be played: ${failure.message}`));
}
