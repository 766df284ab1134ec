// A bat's wing: arm and finger bones, and the membrane between them, hollow between the fingertips.

import { footOf } from "./bat_body.js";
import { colour, mixed, shaded, steps } from "./paint.js";
import { addRod } from "./skeleton.js";
import { Sheet } from "./wing_skin.js";

const ACROSS = 9;
const HOLLOW = 0.19; // depth of the trailing edge between two fingertips, over their distance

export function membrane(planform) {
  const sheet = new Sheet();
  const bones = new Sheet();
  const { wrist, semiSpan, body } = planform;
  const tips = fingertips(planform);
  const paint = { wing: colour(planform.colours.wing), tip: colour(planform.colours.wing_tip) };
  const held = [0, ...tips.map(([eta]) => eta)];
  addMembrane(sheet, planform, held, paint);
  const tone = mixed(paint.wing, colour(planform.colours.breast), 0.22);
  const thick = 0.009 * semiSpan;
  const point = (eta, share, up = 0.25) => {
    const ahead = planform.at(eta, share);
    return [eta, ahead, planform.height(eta, ahead) + up * thick];
  };
  const hand = point(wrist, 0.04);
  addRod(bones, planform, [point(0, 0.25), point(0.5 * wrist, 0.36), hand], [1.5 * thick, 1.2 * thick, 0.9 * thick], tone, {
    from: [0.1 * body.length, 0.2 * body.width, 0.1 * body.depth],
  });
  for (const [eta, ahead] of tips) {
    const straight = eta === 1;
    const path = steps(0, 1, 6).map((s) => {
      const at = wrist + s * (eta - wrist);
      // Fingers bow forward a little; the longest follows the leading edge.
      const line = hand[1] + s * (ahead - hand[1]) + 0.05 * s * (1 - s) * semiSpan;
      const along = straight ? planform.at(at, 0.03) : line;
      return [at, along, planform.height(at, along) + 0.25 * thick * (1 - s)];
    });
    addRod(bones, planform, path, steps(0.75 * thick, 0.18 * thick, 6), tone);
  }
  const thumb = [hand, [wrist + 0.025, hand[1] + 0.045 * semiSpan, hand[2] + thick]];
  addRod(bones, planform, thumb, [0.6 * thick, 0.2 * thick], tone);
  holdRoot(sheet, planform, body);
  return { sheet, bones, held, hollow: HOLLOW };
}

// Fingertips on the outline, [span fraction, metres ahead], from the fifth digit to the third at the tip of the wing.
function fingertips(planform) {
  const { wrist } = planform;
  return [wrist + 0.06 * (1 - wrist), wrist + 0.52 * (1 - wrist), 1].map((eta) => [eta, -planform.behind(eta)]);
}

function addMembrane(sheet, planform, ends, paint) {
  const etas = ends.slice(1).flatMap((end, i) => steps(ends[i], end, 8).slice(i ? 1 : 0));
  const rows = etas.map((eta) => {
    const { behind, share } = planform.edge(eta, ends, HOLLOW);
    const [lead, trail] = [planform.ahead(eta), -behind];
    return steps(0, 1, ACROSS).map((t) => {
      const ahead = trail + t * (lead - trail);
      // Between the fingers the membrane is taut and thin, towards them it gathers.
      const folds = 1 - 0.07 * Math.cos(2 * Math.PI * share) - 0.05 * Math.cos(9 * Math.PI * t) * (1 - t);
      const billow = 0.02 * planform.chord(eta) * 4 * share * (1 - share) * (1 - t) * 2 * t;
      const tone = shaded(mixed(paint.wing, paint.tip, 0.8 * eta), folds);
      return sheet.add(eta, ahead, planform.height(eta, ahead) + billow, 0, tone);
    });
  });
  sheet.grid(rows);
  sheet.root = rows[0];
}

// The membrane grows from the flank and the leg: its inner edge moves with the body.
function holdRoot(sheet, planform, body) {
  const foot = footOf(body);
  sheet.root.forEach((point, j) => {
    const t = j / (ACROSS - 1);
    const x = foot[0] + t * (Math.min(planform.ahead(0), 0.3 * body.length) - foot[0]);
    const along = Math.min(Math.max((x + 0.5 * body.length) / body.length, 0), 1);
    const flank = 0.42 * body.width * Math.sqrt(Math.max(4 * along * (1 - along), 0));
    const near = Math.max(1 - t / 0.35, 0);
    sheet.hold(point, [x, flank + (foot[1] - flank) * near, 0.05 * body.depth * t]);
  });
}
