// How long the last frames of playing took: our script, the calls of three.js, and from frame to frame, ms.

const MOST = 1200;

export class FrameTimes {
  #script = new Float32Array(MOST);
  #render = new Float32Array(MOST);
  #interval = new Float32Array(MOST);
  #count = 0;

  add(script, render, interval) {
    const k = this.#count++ % MOST;
    this.#script[k] = script;
    this.#render[k] = render;
    this.#interval[k] = interval;
  }
  clear() { this.#count = 0; }

  #summary(values) {
    const sorted = values.slice(0, Math.min(this.#count, MOST)).sort();
    if (sorted.length === 0) return {mean: 0, p95: 0, max: 0};
    return {
      mean: sorted.reduce((sum, x) => sum + x, 0) / sorted.length,
      p95: sorted[Math.floor(0.95 * (sorted.length - 1))],
      max: sorted[sorted.length - 1],
    };
  }
  get summary() {
    return {
      frames: Math.min(this.#count, MOST),
      script_ms: this.#summary(this.#script),
      render_ms: this.#summary(this.#render),
      interval_ms: this.#summary(this.#interval),
    };
  }
}
