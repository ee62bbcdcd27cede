// A scene that is turned with the mouse or the keyboard, and the buttons of its figure that show it from one side.
import * as three from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

const SIDES = {iso: [0.62, -1, 0.72], top: [0, -1e-4, 1], front: [0, -1, 0], side: [1, 0, 0]};

// From how far the camera sees all corners of the box, `margin` times as large; `back` points from
// its centre to the camera.
function distanceOf(box, back, camera, margin) {
  const right = new three.Vector3().crossVectors(camera.up, back).normalize();
  const up = new three.Vector3().crossVectors(back, right);
  const half = box.getSize(new three.Vector3()).multiplyScalar(margin / 2);
  const slope = Math.tan(camera.fov / 2 * Math.PI / 180);
  let distance = 1;  // mm, of a box that is a point
  for (let k = 0; k < 8; ++k) {
    const signs = new three.Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    const corner = signs.multiply(half);
    const aside = Math.max(Math.abs(corner.dot(up)), Math.abs(corner.dot(right)) / camera.aspect);
    distance = Math.max(distance, corner.dot(back) + aside / slope);
  }
  return distance;
}

// Arrow keys turn about the target by 5 degrees, plus and minus zoom; the wheel zooms where Ctrl is held or the
// view has the focus, and scrolls the page otherwise.
function listen(element, camera, controls, render) {
  const step = 5 * Math.PI / 180;
  const turns = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]};
  const zooms = {'+': 1 / 1.15, '=': 1 / 1.15, '-': 1.15};
  const place = new three.Spherical();
  const toUpY = new three.Quaternion().setFromUnitVectors(camera.up, new three.Vector3(0, 1, 0));
  const fromUpY = toUpY.clone().invert();
  element.addEventListener('keydown', (event) => {
    const turn = turns[event.key], zoom = zooms[event.key];
    if ((!turn && !zoom) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const back = camera.position.clone().sub(controls.target);
    place.setFromVector3(back.applyQuaternion(toUpY));
    if (turn) {
      place.theta += turn[0];
      place.phi += turn[1];
      place.makeSafe();
    }
    if (zoom) place.radius *= zoom;
    camera.position.setFromSpherical(place).applyQuaternion(fromUpY).add(controls.target);
    controls.update();
    render();
  });
  element.addEventListener('pointerdown', () => element.focus({preventScroll: true}));
  element.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && document.activeElement !== element) event.stopImmediatePropagation();
  }, {capture: true, passive: true});
}

// Scene and camera in `element`; nothing where the browser draws no 3D graphics: what is there without a script
// remains. show(box, margin) begins: the box is in view from all sides; fit(box, margin) shows another one from the
// side that was chosen last; drawAtShare(share) draws with that share of the pixels in each direction.
export function viewIn(element, {antialias = true} = {}) {
  let renderer;
  try {
    renderer = new three.WebGLRenderer({antialias, alpha: true, preserveDrawingBuffer: true});
  } catch {
    return null;
  }
  const scene = new three.Scene();
  const camera = new three.PerspectiveCamera(24, 1, 0.1, 1e5);
  camera.up.set(0, 0, 1);
  const canvas = renderer.domElement;
  element.append(canvas);
  const controls = new OrbitControls(camera, canvas);
  canvas.style.touchAction = 'pan-y';  // a finger that moves up and down scrolls the page
  const render = () => renderer.render(scene, camera);
  let share = 1;
  listen(element, camera, controls, render);
  const resize = () => {
    const width = element.clientWidth;
    const height = element.clientHeight;
    if (width === 0 || height === 0) return;
    renderer.setPixelRatio(share * Math.min(window.devicePixelRatio, 2));
    renderer.setSize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    render();
  };
  const drawAtShare = (next) => {
    if (next === share) return;
    share = next;
    resize();
  };
  const shown = {box: new three.Box3(), margin: 1, side: 'iso'};
  const look = (side) => {
    shown.side = side;
    const center = shown.box.getCenter(new three.Vector3());
    const back = new three.Vector3(...SIDES[side]).normalize();
    const distance = distanceOf(shown.box, back, camera, shown.margin);
    camera.position.copy(back).multiplyScalar(distance).add(center);
    camera.near = distance / 100;
    camera.far = distance * 10;
    camera.updateProjectionMatrix();
    controls.target.copy(center);
    controls.update();
    render();
  };
  const fit = (box, margin) => {
    shown.box.copy(box);
    shown.margin = margin;
    look(shown.side);
  };
  const show = (box, margin) => {
    for (const button of element.closest('figure').querySelectorAll('[data-view]')) {
      button.addEventListener('click', () => look(button.dataset.view));
    }
    element.closest('figure').classList.add('live');
    controls.addEventListener('change', render);
    new ResizeObserver(resize).observe(element);
    resize();
    fit(box, margin);
  };
  return {scene, camera, canvas, controls, render, show, fit, drawAtShare};
}
