// Asks for pictures, one at a time. There is no queue: what to ask for next is decided when the last has come, by what
// is wanted then, so that no outdated picture is made. A whole picture, which may take seconds, is
// broken off for a half one, which shows sooner, and so are the numbers of a pixel for any picture; a half picture never
// is, so that something moves however fast one drags.

import * as api from "./api.js";

export class Pictures {
  #next;
  #waiting = [];
  #runs = false;
  #whole = null;     // what breaks off the whole picture that is on its way, where one is
  #since = 0;        // when that picture was requested
  #instead = false;  // whether the next stands in for one that was broken off
  #othersRun;
  asked = 0;         // so far
  broken = 0;        // of these

  // `next` returns {request, done(picture), failed(error)}, or null if no picture is missing; `othersRun` whether the
  // server runs for something else, which a picture breaks off.
  constructor(next, othersRun) {
    this.#next = next;
    this.#othersRun = othersRun;
  }

  // For how many milliseconds a whole picture has been on its way.
  get running() {
    return this.#whole ? performance.now() - this.#since : 0;
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
      const stop = new AbortController(), instead = this.#instead || this.#othersRun();
      this.#instead = false;
      if (!job.request.half) {
        this.#whole = stop;
        this.#since = performance.now();
      }
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
