// How many of its pixels a moving picture is drawn with: all, or as many as leave time for 60 frames a second where a
// processor, not a graphics card, draws them. A picture at rest has all of them.

const DUE = 1000 / 60;   // from frame to frame, ms
const LATE = 1.25 * DUE;
const WATCHED = 8;       // frames between two changes
const LEAST = 0.4;       // of the pixels in each direction

export class Resolution {
  share = 1;  // in each direction
  #intervals = [];

  // After a frame, that many ms after the one before. True if the share has changed.
  add(interval) {
    this.#intervals.push(interval);
    if (this.#intervals.length < WATCHED) return false;
    const median = this.#intervals.sort((a, b) => a - b)[WATCHED / 2];
    this.#intervals = [];
    if (median <= LATE || this.share === LEAST) return false;
    // Time grows with the number of pixels at most.
    this.share = Math.max(LEAST, this.share * Math.max(0.5, Math.sqrt(DUE / median)));
    return true;
  }
}
