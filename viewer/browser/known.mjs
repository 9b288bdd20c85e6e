// What the report shows beside what is known of tests/report/flat_plates.py.
import assert from "node:assert/strict";

const units = { "Gap to the other surface": "m", Penetration: "m", "Displacement Z": "m", "Velocity X": "m/s" };
/** A text of the pick panel, "4.6667e7 Pa", is a value: to its five digits and the 16 bits of a state's range. */
export function checkValue(text, label, value, where) {
  const [number, unit = ""] = text.replaceAll("−", "-").split(" ");
  assert.equal(unit, units[label] ?? "Pa", `${where}: unit of ${label}`);
  const zero = unit === "Pa" ? 1 : 1e-9; // five digits are shown, and a state's range has 16 bits
  assert.ok(Math.abs(Number(number) - value) < 1e-4 * Math.abs(value) + zero, `${where}: ${label} is ${text}, and should be ${value}`);
}

/** Rows of a picture in which pixels of a colour are. */
export function rows(image, colour) {
  let [top, bottom, count] = [image.height, -1, 0];
  for (let y = 0; y < image.height; y++)
    for (let x = 0; x < image.width; x++)
      if (colour(...image.pixel(x, y))) [top, bottom, count] = [Math.min(top, y), Math.max(bottom, y), count + 1];
  return { top, bottom, count };
}
