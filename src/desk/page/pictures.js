// Asks for pictures, one at a time. There is no queue: what to ask for next is decided when the last has come, by what
// is wanted then, so that nothing is made that nobody looks at any more. A whole picture, which may take seconds, is
// broken off for a half one, which shows sooner; a half one never is, so that something moves however fast one drags.

import * as api from "./api.js";

export class Pictures {
  #next;
  #waiting = [];
  #runs = false;
  #whole = null;     // what breaks off the whole picture that is on its way, where one is
  #instead = false;  // whether the next stands in for one that was broken off
  asked = 0;         // so far
  broken = 0;        // of these

  // `next` returns {request, done(picture), failed(error)}, or null if no picture is missing.
  constructor(next) {
    this.#next = next;
  }

  // To be called after any change of state.
  wake() {
    if (!this.#runs) this.#run();
    else if (this.#whole && this.#next()?.request.half) this.#whole.abort();
  }

  // Waits until no request is running or needed.
  idle() {
    return this.#runs ? new Promise((done) => this.#waiting.push(done)) : Promise.resolve();
  }

  async #run() {
    this.#runs = true;
    // Changes of the same event cause one request.
    await null;
    for (let job; (job = this.#next()) !== null;) {
      ++this.asked;
      const stop = new AbortController(), instead = this.#instead;
      this.#instead = false;
      if (!job.request.half) this.#whole = stop;
      try {
        job.done(await api.picture({...job.request, instead}, stop.signal));
      } catch (error) {
        if (!(error instanceof api.Stopped)) job.failed(error);
        else ++this.broken;
        this.#instead = stop.signal.aborted;
      }
      this.#whole = null;
    }
    this.#runs = false;
    for (const done of this.#waiting.splice(0)) done();
  }
}
