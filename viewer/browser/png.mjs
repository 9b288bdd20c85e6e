// Pixels of a screenshot: 8-bit RGB or RGBA, not interlaced (what Chromium writes).
import { inflateSync } from "node:zlib";

export function readPng(file) {
  let width = 0;
  let height = 0;
  let channels = 0;
  const data = [];
  for (let at = 8; at < file.length; ) {
    const size = file.readUInt32BE(at);
    const kind = file.toString("latin1", at + 4, at + 8);
    const body = file.subarray(at + 8, at + 8 + size);
    if (kind === "IHDR") {
      width = body.readUInt32BE(0);
      height = body.readUInt32BE(4);
      if (body[8] !== 8 || (body[9] !== 2 && body[9] !== 6) || body[12] !== 0) throw new Error("a PNG of another kind");
      channels = body[9] === 2 ? 3 : 4;
    }
    if (kind === "IDAT") data.push(body);
    at += 12 + size;
  }
  const raw = inflateSync(Buffer.concat(data));
  const stride = width * channels;
  const out = new Uint8Array(height * stride);
  for (let y = 0; y < height; y++) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; x++) {
      const left = x >= channels ? out[y * stride + x - channels] : 0;
      const up = y > 0 ? out[(y - 1) * stride + x] : 0;
      const corner = x >= channels && y > 0 ? out[(y - 1) * stride + x - channels] : 0;
      let guess = 0;
      if (filter === 1) guess = left;
      else if (filter === 2) guess = up;
      else if (filter === 3) guess = (left + up) >> 1;
      else if (filter === 4) {
        const p = left + up - corner;
        const [a, b, c] = [Math.abs(p - left), Math.abs(p - up), Math.abs(p - corner)];
        guess = a <= b && a <= c ? left : b <= c ? up : corner;
      }
      out[y * stride + x] = raw[y * (stride + 1) + 1 + x] + guess;
    }
  }
  const pixel = (x, y) => [out[y * stride + x * channels], out[y * stride + x * channels + 1], out[y * stride + x * channels + 2]];
  return { width, height, pixel };
}

/** What a picture shows in front of its background, which is the colour of its corner. */
export function describe(image) {
  const background = image.pixel(2, 2);
  const differs = (p, q) => Math.max(Math.abs(p[0] - q[0]), Math.abs(p[1] - q[1]), Math.abs(p[2] - q[2])) > 12;
  let covered = 0;
  const box = { left: image.width, right: -1, top: image.height, bottom: -1 };
  const colors = new Map();
  for (let y = 0; y < image.height; y++) {
    for (let x = 0; x < image.width; x++) {
      const p = image.pixel(x, y);
      if (!differs(p, background)) continue;
      covered++;
      box.left = Math.min(box.left, x);
      box.right = Math.max(box.right, x);
      box.top = Math.min(box.top, y);
      box.bottom = Math.max(box.bottom, y);
      const key = p.map((v) => v >> 4).join();
      colors.set(key, (colors.get(key) ?? 0) + 1);
    }
  }
  return { background, covered: covered / (image.width * image.height), box, colors };
}

/** Share of pixels that differ between two pictures of one size. */
export function difference(a, b) {
  let count = 0;
  for (let y = 0; y < a.height; y++)
    for (let x = 0; x < a.width; x++) {
      const p = a.pixel(x, y);
      const q = b.pixel(x, y);
      if (Math.max(Math.abs(p[0] - q[0]), Math.abs(p[1] - q[1]), Math.abs(p[2] - q[2])) > 12) count++;
    }
  return count / (a.width * a.height);
}

/** Share of pixels that `is` says yes to. */
export function share(image, is) {
  let count = 0;
  for (let y = 0; y < image.height; y++) for (let x = 0; x < image.width; x++) if (is(...image.pixel(x, y))) count++;
  return count / (image.width * image.height);
}
