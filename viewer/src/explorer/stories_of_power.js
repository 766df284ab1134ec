// Two guided tours about what flight costs: a hummingbird that slows down, and one bat in two kinds of air loads.

import { capital } from "./shared.js";
import { gauge, hertz, judgement, largest, moved, percent, shareOf, since, speed, watts } from "./words.js";

export const hovering = {
  name: "hovering",
  title: "Why hovering costs",
  teaser: "A hummingbird slows down, and its power rises.",
  steps: [
    {
      name: "cheap",
      title: "The cheapest flight",
      flight: { animal: "annas-hummingbird", model: "animal", at: "cheapest" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now }) => [
        `Of the speeds computed here, this hummingbird needs the least power ${speed(now)}: ${watts(now.power)}.`,
        "To stay up it must push air down. The downwash tilts the air loads back, and that costs induced power.",
        `It is ${watts(now.spent.induced)} here, ${percent(shareOf(now, "induced"))} of what is spent on the air.`,
      ],
    },
    {
      name: "slow",
      title: "Slower, with less air to push",
      flight: { animal: "annas-hummingbird", model: "animal", at: "early" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${capital(speed(now))} less air passes the wings in each second, and all of it must go down faster.`,
        ...since(seen.cheap, (cheap) => `Induced power ${moved(cheap.spent.induced, now.spent.induced)}.`),
      ],
    },
    {
      name: "hover",
      title: "No wind but its own",
      flight: { animal: "annas-hummingbird", model: "animal", at: "first" },
      view: { camera: "oblique", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${capital(speed(now))} the bird beats at ${hertz(now.frequency)}.`,
        ...(now.speed ? [] : ["What moves the air past its wings is their beat alone."]),
        ...since(seen.cheap, (cheap) => `Against the cheapest flight, power ${moved(cheap.power, now.power)}.`),
        `Of what is spent on the air, the largest part is ${largest(now)}.`,
      ],
    },
    {
      name: "fast",
      title: "Fast flight",
      flight: { animal: "annas-hummingbird", model: "animal", at: "last" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${capital(speed(now))} air is plentiful, but it drags on body and wings.`,
        ...since(
          seen.hover,
          (hover) => `Against the slowest flight, induced power ${moved(hover.spent.induced, now.spent.induced)}.`,
        ),
        ...since(
          seen.hover,
          (hover) => `The power against the drag of body and tail ${moved(hover.spent.parasite, now.spent.parasite)}.`,
        ),
      ],
    },
    {
      name: "muscle",
      title: "Can its muscle do it?",
      flight: { animal: "annas-hummingbird", model: "animal", at: "first" },
      view: { camera: "front", arrows: false },
      look: "gauges",
      tell: ({ now }) => [
        `Back ${speed(now)}. Power per mass is ${judgement(gauge(now, "positive_power_per_mass"))}.`,
        "The bars show where the other numbers lie. Now drag the point yourself.",
      ],
    },
  ],
};

const PLATE = { animal: "bat", model: "paper", at: "cheapest" };
const FLY = { ...PLATE, model: "dickinson" };

export const coefficients = {
  name: "coefficients",
  title: "A plate against a fruit fly",
  teaser: "The same bat in the same air; only the measured wing differs.",
  steps: [
    {
      name: "plate",
      title: "A bat on flat plates",
      flight: PLATE,
      view: { camera: "oblique", arrows: true },
      look: "picture",
      tell: ({ now }) => [
        "The forces of the air were measured once, on another wing. The model uses them for every strip of this one.",
        "Here it was a flat plate (Su et al. 2023).",
        `So the bat beats at ${hertz(now.frequency)} and needs ${watts(now.power)} ${speed(now)}.`,
      ],
    },
    {
      name: "fly",
      title: "The same bat, a fruit fly's wing",
      flight: FLY,
      placeOf: "plate",
      view: { camera: "oblique", arrows: true },
      pin: "plate",
      look: "picture",
      tell: ({ now, seen }) => [
        "The coefficients now come from a model of a fruit fly's wing in oil (Dickinson et al. 1999).",
        ...since(seen.plate, () => "Animal and speed are the same; the ghost in the picture flies on plates."),
        ...since(seen.plate, (plate) => `The frequency ${moved(plate.frequency, now.frequency, hertz)}.`),
        ...since(seen.plate, (plate) => `Power ${moved(plate.power, now.power)}.`),
      ],
    },
    {
      name: "fast",
      title: "Faster, on plates",
      flight: { ...PLATE, at: "last" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${capital(speed(now))}, on plates again, the bat needs ${watts(now.power)}.`,
        ...since(seen.plate, (plate) => `The frequency ${moved(plate.frequency, now.frequency, hertz)}.`),
      ],
    },
    {
      name: "fastFly",
      title: "Faster, with the fruit fly's wing",
      flight: { ...FLY, at: "last" },
      placeOf: "fast",
      view: { camera: "side", arrows: true },
      pin: "fast",
      look: "curve",
      tell: ({ now, seen }) => [
        ...since(
          seen.fast,
          (fast) => `With the fruit fly's coefficients, power ${moved(fast.power, now.power)} ${speed(now)}.`,
        ),
        "Neither wing is a bat's. The two answers show how much a result depends on that choice.",
      ],
    },
  ],
};
