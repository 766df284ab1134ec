// A robot's wing: a spar along the leading edge, a diagonal, ribs, and a film that lets light through.

import { colour, shaded, steps } from "./paint.js";
import { addRod } from "./skeleton.js";
import { Sheet } from "./wing_skin.js";

const RIBS = [0.2, 0.4, 0.6, 0.8];
const ACROSS = 7;
const HOLLOW = 0.07; // of the trailing edge between two ribs, over their distance

export function film(planform) {
  const [sheet, bones] = [new Sheet(), new Sheet()];
  const { semiSpan } = planform;
  const tone = colour(planform.colours.wing);
  const ends = [0, ...RIBS, 1];
  const etas = ends.slice(1).flatMap((end, i) => steps(ends[i], end, 5).slice(i ? 1 : 0));
  sheet.grid(
    etas.map((eta) => {
      const { behind, share } = planform.edge(eta, ends, HOLLOW);
      const [lead, trail] = [planform.ahead(eta), -behind];
      return steps(0, 1, ACROSS).map((t) => {
        const ahead = trail + t * (lead - trail);
        return sheet.add(eta, ahead, planform.height(eta, ahead), 0, shaded(tone, 1 + 0.08 * share * (1 - share) * 4));
      });
    }),
  );
  const dark = shaded(colour(planform.colours.back), 0.7);
  const thick = 0.008 * semiSpan;
  const point = (eta, share) => {
    const ahead = planform.at(eta, share);
    return [eta, ahead, planform.height(eta, ahead)];
  };
  const spar = steps(0, 1, 11);
  const { width, depth } = planform.body;
  const from = [0.5 * planform.ahead(0), 0.2 * width, 0.05 * depth];
  addRod(bones, planform, spar.map((eta) => point(eta, 0.01)), spar.map((eta) => thick * (1.5 - eta)), dark, { from });
  const diagonal = steps(0, 1, 9);
  addRod(
    bones,
    planform,
    diagonal.map((s) => point(0.72 * s, 0.05 + 0.6 * (1 - s) ** 1.5)),
    diagonal.map(() => 0.5 * thick),
    dark,
    { from: [-0.3 * planform.behind(0), 0.1 * width, 0] },
  );
  for (const eta of RIBS) {
    const along = steps(0, 1, 5);
    addRod(bones, planform, along.map((s) => point(eta, 0.01 + 0.98 * s)), along.map(() => 0.4 * thick), dark);
  }
  return { sheet, bones, held: ends, hollow: HOLLOW };
}
