// A flight as it is handed over from Python: arrays over the samples of a flight, read at any phase.

const KINDS = { f4: Float32Array, f8: Float64Array };

// An array that is unpacked already stays as it is.
function unpacked(array) {
  if (ArrayBuffer.isView(array)) return array;
  const { kind, data, scale, samples } = array;
  const text = atob(data);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i); // ten times as fast as Uint8Array.from
  return kind === "d2" ? summed(bytes, samples, scale) : new KINDS[kind](bytes.buffer);
}

// Whole numbers of 16 bits, packed as steps from sample to sample, one number of a sample after the other; the low bytes
// of all come before their high bytes. The scale is the size of one.
function summed(bytes, samples, scale) {
  const count = bytes.length / 2;
  const width = count / samples;
  const values = new Float32Array(count);
  for (let place = 0; place < width; place++) {
    let whole = 0;
    for (let k = 0; k < samples; k++) {
      const at = place * samples + k;
      whole = ((whole + (bytes[at] | (bytes[count + at] << 8))) << 16) >> 16; // as a signed number of 16 bits
      values[k * width + place] = whole * scale;
    }
  }
  return values;
}

// Four corners of every strip from three, for a strip is a parallelogram.
function completed(three) {
  const four = new Float32Array((three.length * 4) / 3);
  for (let from = 0, to = 0; from < three.length; from += 9, to += 12) {
    for (let i = 0; i < 9; i++) four[to + i] = three[from + i];
    for (let i = 0; i < 3; i++) four[to + 9 + i] = three[from + i] - three[from + 3 + i] + three[from + 6 + i];
  }
  return four;
}

export class Flight {
  constructor(raw) {
    Object.assign(this, raw);
    this.arrays = Object.fromEntries(Object.entries(raw.arrays).map(([name, packed]) => [name, unpacked(packed)]));
    this.phase = this.arrays.phase;
    this.samples = this.phase.length;
    if (this.arrays.corners.length === 9 * this.samples * this.strips) this.arrays.corners = completed(this.arrays.corners);
    this.last = this.phase[this.samples - 1];
    this.advance = this.arrays.x[this.samples - 1] - this.arrays.x[0]; // m, from the start to the end
  }

  // Where a phase lies: the sample before it, and the share of the way to the next.
  locate(phase) {
    let low = 0;
    let high = this.samples - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.phase[middle] <= phase) low = middle;
      else high = middle;
    }
    const share = (phase - this.phase[low]) / (this.phase[high] - this.phase[low]);
    return { low, high, share: Math.min(Math.max(share, 0), 1) };
  }

  // The values of one array at a place, written into `out`.
  read(name, place, out) {
    const values = this.arrays[name];
    const width = values.length / this.samples;
    const before = place.low * width;
    const after = place.high * width;
    for (let i = 0; i < width; i++) {
      out[i] = values[before + i] + place.share * (values[after + i] - values[before + i]);
    }
    return out;
  }

  number(name, place) {
    return this.read(name, place, [0])[0];
  }

  // The mean of an array of numbers over the flight.
  mean(name) {
    const values = this.arrays[name];
    return values.reduce((sum, value) => sum + value, 0) / values.length;
  }

  // The point that the picture moves with: the mean flight of a periodic orbit, the body of any other.
  pivot(phase, place) {
    const { x, z } = this.arrays;
    if (!this.periodic) return [this.number("x", place), this.number("z", place)];
    const share = phase / this.last;
    const end = this.samples - 1;
    return [x[0] + share * (x[end] - x[0]), z[0] + share * (z[end] - z[0])];
  }

  // Largest size of an array's values, or of its vectors.
  largest(name, vector = 1) {
    const values = this.arrays[name];
    let most = 0;
    for (let i = 0; i < values.length; i += vector) {
      let square = 0;
      for (let k = 0; k < vector; k++) square += values[i + k] ** 2;
      most = Math.max(most, square);
    }
    return Math.sqrt(most);
  }
}
