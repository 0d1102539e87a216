// Asks for pictures, one at a time. There is no queue: what to ask for next is decided when the last has come, by what
// is wanted then, so that nothing is made that nobody looks at any more.

import * as api from "./api.js";

export class Pictures {
  #next;
  #waiting = [];
  #runs = false;
  asked = 0;  // so far

  // `next` returns {request, done(picture), failed(error)}, or null if no picture is missing.
  constructor(next) {
    this.#next = next;
  }

  // To be called after any change of state.
  wake() {
    if (!this.#runs) this.#run();
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
      try {
        job.done(await api.picture(job.request));
      } catch (error) {
        job.failed(error);
      }
    }
    this.#runs = false;
    for (const done of this.#waiting.splice(0)) done();
  }
}
