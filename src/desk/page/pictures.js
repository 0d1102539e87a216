// Asks for pictures, one at a time. There is no queue: what to ask for next is decided when the last has come, by what
// is wanted then, so that nothing is made that nobody looks at any more.

import * as api from "./api.js";

export class Pictures {
  #next;
  #waiting = [];
  #runs = false;
  asked = 0;  // so far

  // `next` gives {request, done(picture), failed(error)}, or null where all that is wanted is there.
  constructor(next) {
    this.#next = next;
  }

  // To be called whenever something else may be wanted.
  wake() {
    if (!this.#runs) this.#run();
  }

  // Until nothing is on its way, and nothing is wanted.
  idle() {
    return this.#runs ? new Promise((done) => this.#waiting.push(done)) : Promise.resolve();
  }

  async #run() {
    this.#runs = true;
    // What is changed in one go is asked for in one.
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
