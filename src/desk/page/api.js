// The page's requests to the tool that serves it. All addresses are below the page's own, which contains the secret.

// A refusal by the tool, as a sentence: a value out of range, an existing file (status 409).
export class Refused extends Error {
  constructor(sentence, status) {
    super(sentence);
    this.status = status;
  }
}

// The picture is no longer wanted: by this page, or by another one of this desk (status 410).
export class Stopped extends Error {}

// Nobody answers: the tool has ended.
export class Gone extends Error {}

async function reply(name, body, signal) {
  let response;
  try {
    response = await fetch("api/" + name, body && {
      method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body), signal,
    });
  } catch (cause) {
    if (signal?.aborted) throw new Stopped();
    throw new Gone("limpid does not answer", {cause});
  }
  if (response.ok) return response;
  if (response.status === 410) throw new Stopped();
  const text = await response.text();
  let sentence = text;
  try {
    sentence = JSON.parse(text).error ?? text;
  } catch {}  // some refusals are plain text
  throw new Refused(sentence || `refused with status ${response.status}`, response.status);
}

const json = async (name, body) => (await reply(name, body)).json();

export const describe = () => json("desk");
export const pixel = (request) => json("pixel", request);
export const save = (request) => json("save", request);
export const command = (request) => json("command", request);

// What there is to say of the picture, with "image", its ImageData: four bytes of length, that much JSON, the pixels.
export async function picture(request, signal) {
  const response = await reply("picture", request, signal);
  let bytes;
  try {
    bytes = await response.arrayBuffer();
  } catch (cause) {
    if (signal.aborted) throw new Stopped();
    throw new Gone("limpid ended while it answered", {cause});
  }
  const length = new DataView(bytes).getUint32(0, true);
  const said = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
  return {...said, image: new ImageData(new Uint8ClampedArray(bytes, 4 + length), said.width, said.height)};
}
