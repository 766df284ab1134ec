// A bird's wing: primaries that fan from the hand to the tip, secondaries on the arm, two rows of coverts, and the arm
// itself as a thin aerofoil. Feathers keep their width, so that they overlap more when the span is retracted.

import { colour, mixed, ramp, shaded, steps } from "./paint.js";
import { outerVane, vane } from "./vane.js";
import { Sheet } from "./wing_skin.js";

const PRIMARIES = 10;
const HALF = 6; // points of the arm's section above, and below
const SECONDARIES = 26; // in a whole span; a short arm has fewer
const SHORT = [0, 0.6, 0.88, 1];

export function feathers(planform) {
  const sheet = new Sheet();
  const { semiSpan } = planform;
  const paint = { wing: colour(planform.colours.wing), tip: colour(planform.colours.wing_tip) };
  const flight = flightFeathers(planform);
  flight.forEach((feather) => addFeather(sheet, planform, feather, paint));
  for (const row of [
    { reach: 0.5, start: 0.75, up: 0.01, many: 15, shade: 0.97 },
    { reach: 0.28, start: 0.35, up: 0.018, many: 18, shade: 1.03 },
  ]) {
    coverts(planform, flight, row).forEach((feather) => addFeather(sheet, planform, feather, paint));
  }
  addArm(sheet, planform, shaded(paint.wing, 1.05), Math.min(0.12 * semiSpan, planform.body.width * 0.4));
  return { sheet, held: [0, 1], hollow: 0 };
}

// Share of the chord that the arm and the hand fill, from the leading edge.
function fleshy(planform, eta) {
  const end = handEnd(planform);
  return eta < planform.wrist
    ? 0.4 - (0.14 * eta) / planform.wrist
    : 0.26 * Math.max(1 - ((eta - planform.wrist) / (end - planform.wrist)) ** 2, 0);
}

function handEnd({ wrist }) {
  return wrist + 0.5 * (1 - wrist);
}

// Base and tip of every flight feather, [span fraction, metres ahead], from the root outwards. Tips lie on the outline.
function flightFeathers(planform) {
  const { wrist, semiSpan } = planform;
  const found = [];
  const inner = steps(0.02, wrist, Math.max(Math.round(SECONDARIES * wrist), 5));
  const apart = (inner[1] - inner[0]) * semiSpan;
  // Tertials close the gap between the arm and the body.
  for (const share of [0.3, 0.13]) {
    const eta = (-share * planform.body.width) / semiSpan;
    const tip = [eta, -(0.94 - 0.3 * share) * planform.behind(0)];
    const half = 0.13 * planform.body.width;
    found.push({ base: [eta, planform.at(0, 0.3)], tip, half, hand: 0, follow: 0, round: 0.3 });
  }
  inner.forEach((eta, i) => {
    const base = Math.max(eta - 0.02 * (i / inner.length), 0);
    found.push({
      base: [base, planform.at(base, 0.8 * fleshy(planform, base))],
      tip: [eta, -planform.behind(eta)],
      half: 0.95 * apart,
      hand: 0,
      follow: 0,
      round: 0.18,
    });
  });
  const tips = planform.outline(wrist, PRIMARIES);
  const gaps = tips.map((tip, i) => {
    const before = i ? tips[i - 1] : [wrist, -planform.behind(wrist)];
    return Math.hypot((tip[0] - before[0]) * semiSpan, tip[1] - before[1]);
  });
  tips.forEach((tip, i) => {
    const share = (i + 1) / PRIMARIES;
    const base = wrist + (handEnd(planform) - wrist) * share ** 1.2;
    found.push({
      base: [base, planform.at(base, 0.6 * fleshy(planform, base) + 0.06)],
      tip,
      half: 0.95 * gaps[i],
      hand: share,
      follow: share ** 3,
      round: 0.26,
    });
  });
  return found;
}

// Short feathers over the bases of the long ones. `reach`: how far back along the flight feathers they go.
function coverts(planform, flight, { reach, start, up, many, shade }) {
  return Array.from({ length: many }, (_, i) => {
    const place = (i / (many - 1)) * (flight.length - 1.0001);
    const low = Math.floor(place);
    const between = (name) => [0, 1].map((k) => {
      const [one, two] = [flight[low][name][k], flight[low + 1][name][k]];
      return one + (place - low) * (two - one);
    });
    const [base, tip] = [between("base"), between("tip")];
    const from = [base[0], planform.at(base[0], start * fleshy(planform, base[0]))];
    const hand = flight[low].hand;
    const far = reach * (1 - 0.35 * hand);
    const until = [0, 1].map((k) => base[k] + far * (tip[k] - base[k]));
    return {
      base: from,
      tip: until,
      half: (0.75 * planform.semiSpan * 0.9) / many,
      hand: 0.55 * hand,
      follow: flight[low].follow,
      round: 0.35,
      along: SHORT,
      shade,
      up,
    };
  });
}

function addFeather(sheet, planform, feather, paint) {
  const { base, tip, hand, follow, round, along, up = 0, shade = 1 } = feather;
  const { semiSpan } = planform;
  // Outer primaries run along the leading edge until they reach their tip.
  const straight = (s) => [base[1] + s * (tip[1] - base[1]), (base[0] + s * (tip[0] - base[0])) * semiSpan];
  // Towards a pointed tip feathers are slender.
  const half = (s) => Math.min(feather.half, 0.3 * planform.chord(straight(s)[1] / semiSpan));
  const edge = (s) => {
    const eta = straight(s)[1] / semiSpan;
    const slope = (planform.ahead(eta + 0.02) - planform.ahead(eta - 0.02)) / (0.04 * semiSpan);
    return planform.ahead(eta) - outerVane(s, half, round) * Math.hypot(1, slope);
  };
  const miss = [edge(0) - base[1], edge(1) - tip[1]];
  const path = (s) => {
    const [ahead, out] = straight(s);
    return [ahead + follow * (edge(s) - (1 - s) * miss[0] - s * miss[1] - ahead), out];
  };
  const tint = (s) => {
    const dark = Math.max(hand * ramp(s, 0.05, 0.7), 0.35 * ramp(s, 0.75, 1));
    return shaded(mixed(paint.wing, paint.tip, dark), shade);
  };
  const rows = vane({ path, half, round, tint, ...(along && { along }) }, (s, here, off, lift, tone) => {
    // Inside the shoulder there is no strip: there a feather moves with the innermost one.
    const eta = Math.max(here[1] / semiSpan, 0);
    const ahead = here[0] + off[0];
    const layer = up * planform.chord(Math.min(eta, 0.8)) * Math.min(2 * s, 1);
    return sheet.add(eta, ahead, planform.height(eta, here[0]) + layer + lift, off[1] + Math.min(here[1], 0), tone);
  });
  sheet.grid(rows);
}

// Arm and hand: a closed section around the leading edge. It reaches into the body by `inwards` metres.
function addArm(sheet, planform, tone, inwards) {
  const end = handEnd(planform);
  const around = [...steps(1, 0, HALF), ...steps(0, 1, HALF).slice(1)];
  const row = (eta, out) => {
    const [deep, chord] = [fleshy(planform, eta), planform.chord(eta)];
    const taper = (1 + 0.8 * Math.exp(-eta / 0.06)) * Math.min(3 * (1 - eta / end) + 0.15, 1);
    const thick = planform.thickness * chord * taper;
    return around.map((x, i) => {
      const share = deep * x * x;
      const ahead = planform.at(eta, share);
      const bulge = 1.3 * thick * x * (1 - x ** 3) * (i < HALF ? 0.62 : -0.42);
      return sheet.add(eta, ahead, planform.height(eta, ahead) + bulge, out, shaded(tone, i < HALF ? 1 : 1.12));
    });
  };
  sheet.grid([row(0, -inwards), ...steps(0, end, 11).map((eta) => row(eta, 0))]);
}
