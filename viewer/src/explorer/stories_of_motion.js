// Two guided tours about a flight as a whole: what a robot must give, and what a gust does to a bird.

import { capital } from "./shared.js";
import {
  amplitude,
  enough,
  gust,
  hertz,
  listed,
  metres,
  moved,
  since,
  speed,
  stability,
  watts,
} from "./words.js";

const ROBOT = { animal: "robofalcon2", model: ["paper", "animal"] };

export const robot = {
  name: "robot",
  title: "Build a robot",
  teaser: "From weight and span to a gait, and to what the motor must give.",
  steps: [
    {
      name: "weight",
      title: "Start from the weight",
      flight: { ...ROBOT, at: "cheapest" },
      view: { camera: "front", arrows: false },
      look: "picture",
      tell: ({ now, semiSpan }) => [
        `This ${now.title} has a mass of ${listed(now, "mass")} and two wings of ${metres(semiSpan)} each.`,
        "Over a beat, the wings must carry the weight and balance the drag.",
        "At the end of the beat the body must have the attitude and the velocities that it began with.",
      ],
    },
    {
      name: "gait",
      title: "Find a gait that closes",
      flight: { ...ROBOT, at: "cheapest" },
      view: { camera: "side", arrows: true },
      look: "picture",
      tell: ({ now }) => [
        `The solver looks for a wingbeat that repeats itself. It beats at ${hertz(now.frequency)} ${speed(now)}.`,
        ...amplitude(now),
        "Arrows show the air load on each strip of the wing.",
      ],
    },
    {
      name: "motor",
      title: "What the motor must give",
      flight: { ...ROBOT, at: "cheapest" },
      view: { camera: "side", arrows: true },
      look: "gauges",
      tell: ({ now }) => [
        `The hinges of the wings need ${watts(now.power)}: the mean over a beat, braking not counted.`,
        `That is ${watts(now.power / now.mass)} for each kilogram of the robot.`,
        "Gears and motor lose some of what they draw, so the battery must give more.",
      ],
    },
    {
      name: "slow",
      title: "Slow flight",
      flight: { ...ROBOT, at: "first" },
      view: { camera: "oblique", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `The slowest flight computed here, ${speed(now)}, needs ${watts(now.power)}.`,
        ...since(
          seen.gait,
          (gait) => `Against the cheapest flight the frequency ${moved(gait.frequency, now.frequency, hertz)}.`,
        ),
      ],
    },
    {
      name: "fast",
      title: "Fast flight",
      flight: { ...ROBOT, at: "last" },
      view: { camera: "oblique", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${capital(speed(now))} it needs ${watts(now.power)}.`,
        ...since(
          seen.gait,
          ({ power }) => `A motor sized for the cheapest flight, with ${watts(power)}, ${enough(power, now.power)}.`,
        ),
        "For a robot of your own, write its numbers into a species file and drop it on this page.",
      ],
    },
  ],
};

const PIGEON = { animal: "pigeon", model: ["paper", "animal"], at: "pushed" };
const FREE = { direction: "tail", feedback: false };

export const tumbling = {
  name: "tumbling",
  title: "Why it tumbles",
  teaser: "One gust, first with a fixed wingbeat, then with feedback.",
  steps: [
    {
      name: "orbit",
      title: "A flight that repeats itself",
      flight: PIGEON,
      view: { camera: "side", arrows: false },
      look: "picture",
      tell: ({ now }) => [
        `${capital(speed(now))} the pigeon flies a beat that ends as it began. Undisturbed, it would go on for ever.`,
        ...stability(now),
      ],
    },
    {
      name: "free",
      title: "A gust, and a wingbeat that does not react",
      flight: PIGEON,
      view: { camera: "side", arrows: false },
      push: FREE,
      look: "picture",
      tell: ({ push }) => [
        `The pigeon meets ${gust(push)}. Its wings go on beating as before.`,
        `It is ${push.outcome}.`,
      ],
    },
    {
      name: "held",
      title: "The same gust, with feedback",
      flight: PIGEON,
      view: { camera: "side", arrows: false },
      push: { ...FREE, feedback: true },
      look: "picture",
      tell: ({ push }) => [
        `Again ${gust(push)}. Now feedback sees attitude and velocities once in each beat, and changes the wingbeat.`,
        `It is ${push.outcome}.`,
      ],
    },
    {
      name: "again",
      title: "Push it yourself",
      flight: PIGEON,
      view: { camera: "side", arrows: false },
      push: { direction: "upward", feedback: false },
      look: "picture",
      tell: ({ push }) => [
        `Now ${gust(push)}, again without feedback. The pigeon is ${push.outcome}.`,
        "Below the picture you can choose the gust yourself.",
        "The feedback follows from the equations of motion; how birds do it is not modelled.",
      ],
    },
  ],
};
