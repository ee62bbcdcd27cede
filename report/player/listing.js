// The NC program as a list of lines, of which only those in sight are elements; one of them is the current one.

const HEIGHT = 22;  // px, of a line (style.css)

export class Listing {
  text = 0;
  line = 0;

  #list;
  #rows;
  #pool = [];
  #lines = [];
  #moving = new Set();
  #first = 0;   // of the lines that are elements, counted from 0
  #count = 0;
  // As the browser said last: asking it anew would make it lay out the page.
  #top = 0;
  #height = 0;

  // `choose` is called with a line that was clicked or reached with the keys.
  constructor(list, choose) {
    this.#list = list;
    this.#rows = list.querySelector('.rows');
    list.addEventListener('scroll', () => {
      this.#top = list.scrollTop;
      this.#fill();
    });
    new ResizeObserver(() => {
      this.#height = list.clientHeight;
      this.#fill(true);
    }).observe(list);
    list.addEventListener('click', (event) => {
      const row = event.target.closest('[data-line]');
      if (row) choose(Number(row.dataset.line));
    });
    list.addEventListener('keydown', (event) => {
      const page = Math.max(1, Math.floor(this.#height / HEIGHT) - 1);
      const steps = {ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity};
      const step = steps[event.key];
      if (step === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      event.stopPropagation();
      choose(Math.min(Math.max(this.line + step, 1), this.#lines.length), step);
    });
  }

  // `lines`: all of a text; `moving`: those that move the tool.
  open(text, lines, moving) {
    this.text = text;
    this.line = 0;
    this.#lines = lines;
    this.#moving = moving;
    this.#rows.style.height = `${lines.length * HEIGHT}px`;
    this.#fill(true);
  }

  show(line) {
    if (line === this.line) return;
    const before = this.line;
    this.line = line;
    const top = (line - 1) * HEIGHT;
    if (top < this.#top || top + HEIGHT > this.#top + this.#height) {
      this.#top = Math.max(0, top - Math.floor(this.#height / 3));
      this.#list.scrollTop = this.#top;
      this.#fill();
    }
    this.#mark(before);
    this.#mark(line);
    this.#nameCurrent();
  }

  #row(k) {
    if (!this.#pool[k]) {
      const row = document.createElement('div');
      row.setAttribute('role', 'option');
      const number = document.createElement('span');
      number.className = 'number';
      const words = document.createElement('span');
      words.className = 'words';
      row.append(number, words);
      this.#rows.append(row);
      this.#pool[k] = row;
    }
    return this.#pool[k];
  }

  #mark(line) {
    const k = line - 1 - this.#first;
    if (k >= 0 && k < this.#count) this.#pool[k].setAttribute('aria-selected', String(line === this.line));
  }
  #nameCurrent() {
    const k = this.line - 1 - this.#first;
    if (k >= 0 && k < this.#count) this.#list.setAttribute('aria-activedescendant', `nc-line-${this.line}`);
    else this.#list.removeAttribute('aria-activedescendant');
  }

  #fill(anew = false) {
    const count = Math.min(this.#lines.length, Math.ceil(this.#height / HEIGHT) + 2);
    const first = Math.max(0, Math.min(Math.floor(this.#top / HEIGHT), this.#lines.length - count));
    if (!anew && first === this.#first && count === this.#count) return;
    this.#first = first;
    this.#count = count;
    for (let k = 0; k < count; ++k) {
      const row = this.#row(k), line = first + k + 1;
      row.hidden = false;
      row.dataset.line = line;
      row.id = `nc-line-${line}`;
      row.style.transform = `translateY(${(line - 1) * HEIGHT}px)`;
      row.setAttribute('aria-setsize', this.#lines.length);
      row.setAttribute('aria-posinset', line);
      row.setAttribute('aria-selected', String(line === this.line));
      row.classList.toggle('still-line', !this.#moving.has(line));
      row.firstChild.textContent = line;
      row.lastChild.textContent = this.#lines[line - 1];
    }
    for (let k = count; k < this.#pool.length; ++k) {
      this.#pool[k].hidden = true;
      this.#pool[k].removeAttribute('id');
    }
    this.#nameCurrent();
  }
}
