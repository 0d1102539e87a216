// Undo and redo of a value that is never changed, only replaced. While one drags it is replaced many times a second:
// that is one step, which ends with settle().

export class History {
  #past = [];
  #future = [];
  #settled;

  constructor(now) {
    this.now = this.#settled = now;
  }

  get canUndo() { return this.#past.length > 0 || this.now !== this.#settled; }
  get canRedo() { return this.#future.length > 0; }

  // Without a step: as one drags.
  replace(value) {
    this.now = value;
  }

  // Makes a step of what was replaced since the last.
  settle() {
    if (this.now === this.#settled) return;
    this.#past.push(this.#settled);
    this.#future = [];
    this.#settled = this.now;
  }

  undo() {
    this.settle();
    this.#move(this.#past, this.#future);
  }

  redo() {
    this.settle();
    this.#move(this.#future, this.#past);
  }

  // The value is no good: back to the one before it, as if it had never been. Without one it stays.
  forget() {
    if (this.now === this.#settled) this.#settled = this.#past.pop() ?? this.#settled;
    this.now = this.#settled;
  }

  #move(from, to) {
    if (from.length === 0) return;
    to.push(this.now);
    this.now = this.#settled = from.pop();
  }
}
