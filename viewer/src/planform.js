// The outline of a wing seen from above, as the scene's shape has it: span fraction, and metres ahead of the pitch axis.

export class Planform {
  constructor(shape, semiSpan) {
    Object.assign(this, shape, { semiSpan });
  }

  // Metres from the pitch axis ahead to the leading edge, and back to the trailing edge.
  ahead(eta) {
    return table(this.leading, eta);
  }

  behind(eta) {
    return table(this.trailing, eta);
  }

  chord(eta) {
    return this.ahead(eta) + this.behind(eta);
  }

  // A point at a share of the local chord behind the leading edge.
  at(eta, share) {
    return this.ahead(eta) - share * this.chord(eta);
  }

  // Metres from the pitch axis back to the drawn edge, which a membrane or a film has hollow between its bones: the list
  // `held` of span fractions at which the edge reaches the outline, and the depth of a hollow over its width.
  edge(eta, held, depth) {
    const i = Math.max(held.findIndex((end) => end >= eta - 1e-9), 1);
    const share = (eta - held[i - 1]) / (held[i] - held[i - 1]);
    const gap = (held[i] - held[i - 1]) * this.semiSpan;
    const hollow = Math.min(4 * depth * gap * share * (1 - share), 0.45 * this.chord(eta));
    return { behind: this.behind(eta) - hollow, share };
  }

  // Height of the camber line: zero at both edges, which lie in the strip's plane.
  height(eta, ahead) {
    const chord = this.chord(eta);
    if (chord <= 0) return 0;
    const share = Math.min(Math.max((this.ahead(eta) - ahead) / chord, 0), 1);
    return 4 * this.camber * chord * share * (1 - share);
  }

  // Points [span fraction, metres ahead] at equal distances along the outline, from the trailing edge at a span fraction
  // to the tip and its leading edge.
  outline(eta, count) {
    const path = [];
    for (let i = 0; i <= 400; i++) {
      const at = eta + ((1 - eta) * i) / 400;
      path.push([at, -this.behind(at)]);
    }
    path.push([1, this.ahead(1)]);
    const lengths = [0];
    for (let i = 1; i < path.length; i++) {
      const [one, two] = [path[i - 1], path[i]];
      lengths.push(lengths[i - 1] + Math.hypot((two[0] - one[0]) * this.semiSpan, two[1] - one[1]));
    }
    const whole = lengths.at(-1);
    return Array.from({ length: count }, (_, n) => {
      const wanted = ((n + 1) / count) * whole;
      const after = Math.max(lengths.findIndex((length) => length >= wanted * (1 - 1e-12)), 1);
      const share = Math.min((wanted - lengths[after - 1]) / (lengths[after] - lengths[after - 1] || 1), 1);
      return [0, 1].map((k) => path[after - 1][k] + share * (path[after][k] - path[after - 1][k]));
    });
  }
}

function table(values, eta) {
  const place = Math.min(Math.max(eta, 0), 1) * (values.length - 1);
  const low = Math.min(Math.floor(place), values.length - 2);
  return values[low] + (place - low) * (values[low + 1] - values[low]);
}
