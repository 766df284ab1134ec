// A guided tour whose slider is a spring: a robot whose wings pitch as their hinges let them.

import { along, command, degrees, figure, gauge, hertz, listed, moved, since, stableAlong, watts } from "./words.js";

const HINGE = { animal: "robofalcon2", model: "animal", along: "pitch_hinge.stiffness" };
const SWING = "amplitude of the wing's pitch";
const LEAD = "lead of the wing's pitch over its flap";

export const hinges = {
  name: "hinges",
  title: "Which spring for the wing?",
  teaser: "No motor pitches these wings. The slider is the stiffness of their hinges.",
  steps: [
    {
      name: "soft",
      title: "A soft spring",
      flight: { ...HINGE, at: "first" },
      view: { camera: "side", arrows: true },
      look: "picture",
      tell: ({ now }) => [
        "A motor flaps these wings. What pitches them are the air and their own inertia, against spring and damper.",
        `The softest spring computed here has ${along(now)}. The pitch swings by ${degrees(figure(now, SWING))} to either side.`,
        `The flight needs ${watts(now.power)}.`,
      ],
    },
    {
      name: "cheapest",
      title: "The spring that costs least",
      flight: { ...HINGE, at: "cheapest" },
      view: { camera: "side", arrows: true },
      pin: "soft",
      look: "curve",
      tell: ({ now, seen, points }) => [
        `Of the ${points.length} springs computed here, that with ${along(now)} needs the least power, ${watts(now.power)}.`,
        ...since(
          seen.soft,
          (soft) => `Against the soft spring, the ghost, the swing ${moved(figure(soft, SWING), figure(now, SWING), degrees)}.`,
        ),
        ...since(seen.soft, (soft) => `The frequency ${moved(soft.frequency, now.frequency, hertz)}${held(now)}.`),
      ],
    },
    {
      name: "stiff",
      title: "Stiffer still",
      flight: { ...HINGE, at: "last" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `With ${along(now)} the pitch swings by ${degrees(figure(now, SWING))} to either side.`,
        ...since(seen.cheapest, (cheapest) => `Against the cheapest spring, power ${moved(cheapest.power, now.power)}.`),
      ],
    },
    {
      name: "stable",
      title: "Does it stay on its course?",
      flight: { ...HINGE, at: "stable" },
      view: { camera: "oblique", arrows: false },
      look: "curve",
      tell: ({ now, seen, points }) => [
        ...stableAlong(points, now.axis),
        ...since(
          listed(now, "a small disturbance") === "decays",
          () => `Of the stable ones, that with ${along(now)} needs the least power.`,
        ),
        ...since(seen.cheapest, (cheapest) => `Against the cheapest of all, power ${moved(cheapest.power, now.power)}.`),
      ],
    },
    {
      name: "wing",
      title: "What the wing does",
      flight: { ...HINGE, at: "stable" },
      placeOf: "stable",
      view: { camera: "side", arrows: true },
      look: "picture",
      tell: ({ now, seen }) => [
        `Watch the wing turn about its axis. Its leading edge is ${mid(now)} in the downstroke than in the upstroke.`,
        `The pitch leads the flap by ${degrees(figure(now, LEAD))}. By a quarter of a beat, it would be largest at mid-stroke.`,
        ...since(
          seen.soft,
          (soft) => `From the soft spring to this one, the lead ${moved(figure(soft, LEAD), figure(now, LEAD), degrees)}.`,
        ),
      ],
    },
    {
      name: "next",
      title: "Fly your own hinge",
      flight: { ...HINGE, at: "stable" },
      placeOf: "stable",
      view: { camera: "side", arrows: false },
      look: "curve",
      tell: ({ now }) => [
        "This command flies the hinge of this step, and saves the flight. Put your own numbers in:",
        `\`${command(now)} -o gait.nc\``,
        `With \`--free ${now.axis.name}\` the solver chooses the spring. And this tells what becomes of disturbances:`,
        "`wingbeat stability gait.nc`",
      ],
    },
  ],
};

// What holds a frequency, if it was not the solver's choice.
const held = (answer) => (gauge(answer, "frequency")?.limited ? ", where a limit holds it" : "");

// At mid-downstroke a pitch that leads the flap by less than half a beat is below its mean.
const mid = (answer) => (Math.sin((figure(answer, LEAD) * Math.PI) / 180) > 0 ? "lower" : "higher");
