// Thin rods in a wing: bones of a bat, spars and ribs of a robot.

// A rod through points [span fraction, metres ahead, metres up] with radii [m]; it keeps its thickness as the wing moves.
// It may begin at a place in the body [x, y, z], so that the wing stays attached to the body at every angle.
export function addRod(sheet, planform, points, radii, tone, { around = 5, from } = {}) {
  const { semiSpan } = planform;
  const rows = points.map(([eta, ahead, up], i) => {
    const [before, after] = [points[Math.max(i - 1, 0)], points[Math.min(i + 1, points.length - 1)]];
    const [forward, out] = [after[1] - before[1], (after[0] - before[0]) * semiSpan];
    const length = Math.hypot(forward, out) || 1;
    return Array.from({ length: around + 1 }, (_, j) => {
      const angle = (2 * Math.PI * j) / around;
      const [aside, above] = [radii[i] * Math.cos(angle), radii[i] * Math.sin(angle)];
      return sheet.add(eta, ahead + (out / length) * aside, up + above, (-forward / length) * aside, tone);
    });
  });
  if (from) {
    const [eta, ahead, up] = points[0];
    const begin = rows[0].map(() => sheet.add(eta, ahead, up, 0, tone));
    for (const point of begin) sheet.hold(point, from);
    rows.unshift(begin);
  }
  sheet.grid(rows.map((row) => row.reverse()));
}
