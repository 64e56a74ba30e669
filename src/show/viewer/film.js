// Saves what the view shows: a picture, or a film of the motion from its beginning to its end, in
// the format that the browser has.
import { el } from "./dom.js";

const kinds = ["video/mp4;codecs=avc1.640028", "video/webm;codecs=vp9", "video/webm"];
const kind = globalThis.MediaRecorder && kinds.find((type) => MediaRecorder.isTypeSupported(type));
export const canFilm = Boolean(kind);
const size = [1280, 720], bitsPerSecond = 8e6;

function save(blob, name) {
  const url = URL.createObjectURL(blob);
  el("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60000);
}

export function savePicture(stage, name) {
  stage.drawNow();
  stage.renderer.domElement.toBlob((blob) => save(blob, `${name}.png`));
}

// It runs as long as the motion is played; end() saves it, cancel() does not.
export class Film {
  constructor(stage, name) {
    this.stage = stage;
    stage.fix(...size);
    const parts = [], end = kind.startsWith("video/mp4") ? "mp4" : "webm";
    this.recorder = new MediaRecorder(stage.renderer.domElement.captureStream(),
      { mimeType: kind, videoBitsPerSecond: bitsPerSecond });
    this.recorder.ondataavailable = ({ data }) => parts.push(data);
    this.recorder.onstop = () => {
      stage.fix();
      if (!this.cancelled && parts.some((part) => part.size > 0)) save(new Blob(parts, { type: kind }), `${name}.${end}`);
    };
    this.recorder.start();
  }

  end() {
    this.stage.drawNow(); // the last frame
    this.recorder.stop();
  }

  cancel() {
    this.cancelled = true;
    this.recorder.stop();
  }
}
