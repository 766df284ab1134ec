// Thin rods in a wing: bones of a bat, spars and ribs of a robot.

// A rod through points [span fraction, metres ahead, metres up] with radii [m]; it keeps its thickness as the wing moves.
export function addRod(sheet, planform, points, radii, tone, around = 5) {
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
  sheet.grid(rows.map((row) => row.reverse()));
}
