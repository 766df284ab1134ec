// Two guided tours about what flight costs: a hummingbird that slows down, and one bat in two kinds of air loads.

import { first, gauge, hertz, judgement, largest, moved, percent, shareOf, speed, watts } from "./words.js";

export const hovering = {
  name: "hovering",
  title: "Why hovering costs",
  teaser: "A hummingbird slows down, and its power rises.",
  steps: [
    {
      name: "cheap",
      title: "The cheapest flight",
      flight: { animal: "annas-hummingbird", model: "animal", speed: "cheapest" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now }) => [
        `Of the speeds computed here, this hummingbird needs least power ${speed(now)}: ${watts(now.power)}.`,
        "To stay up it must push air down. The downwash tilts the air loads back, and that costs induced power.",
        `Here induced power is ${watts(now.spent.induced)}, ${percent(shareOf(now, "induced"))} of what is spent on the air.`,
      ],
    },
    {
      name: "slow",
      title: "Slower, with less air to push",
      flight: { animal: "annas-hummingbird", model: "animal", speed: "slow" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${first(speed(now))} less air passes the wings in each second, and all of it must go down faster.`,
        ...(seen.cheap ? [`Induced power ${moved(seen.cheap.spent.induced, now.spent.induced)}.`] : []),
      ],
    },
    {
      name: "hover",
      title: "No wind but its own",
      flight: { animal: "annas-hummingbird", model: "animal", speed: "slowest" },
      view: { camera: "oblique", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${first(speed(now))} the bird beats at ${hertz(now.frequency)}.`,
        ...(now.speed ? [] : ["What moves the air past its wings is their beat alone."]),
        ...(seen.cheap ? [`Against the cheapest flight, power ${moved(seen.cheap.power, now.power)}.`] : []),
        `Induced power is ${watts(now.spent.induced)}. The largest part of what is spent on the air is ${largest(now)}.`,
      ],
    },
    {
      name: "fast",
      title: "Why the curve rises again",
      flight: { animal: "annas-hummingbird", model: "animal", speed: "fastest" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${first(speed(now))} air is plentiful, but it drags on body and wings.`,
        ...(seen.hover ? [`Against the slowest flight, induced power ${moved(seen.hover.spent.induced, now.spent.induced)}.`] : []),
        ...(seen.hover ? [`Drag of body and tail costs ${watts(now.spent.parasite)}; there it cost ${watts(seen.hover.spent.parasite)}.`] : []),
      ],
    },
    {
      name: "muscle",
      title: "Can its muscle do it?",
      flight: { animal: "annas-hummingbird", model: "animal", speed: "slowest" },
      view: { camera: "front", arrows: false },
      look: "gauges",
      tell: ({ now }) => [
        `Back ${speed(now)}. Power per mass is ${judgement(gauge(now, "positive_power_per_mass"))}.`,
        "The bars show where the other numbers lie. Now drag the point yourself.",
      ],
    },
  ],
};

const PLATE = { animal: "bat", model: "paper", speed: "cheapest" };
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
        "What a wing feels in the air is measured once, on another wing, and then used for every strip.",
        `Here it was a flat plate (Su et al. 2023). The bat beats at ${hertz(now.frequency)} and needs ${watts(now.power)} ${speed(now)}.`,
      ],
    },
    {
      name: "fly",
      title: "The same bat, a fruit fly's wing",
      flight: FLY,
      speedOf: "plate",
      view: { camera: "oblique", arrows: true },
      pin: "plate",
      look: "picture",
      tell: ({ now, seen }) => [
        "Animal, speed and question are the same. The coefficients now come from a model of a fruit fly's wing in oil (Dickinson et al. 1999).",
        ...(seen.plate ? [`The frequency ${moved(seen.plate.frequency, now.frequency, hertz)}, power ${moved(seen.plate.power, now.power)}. The ghost is the flight on plates.`] : []),
      ],
    },
    {
      name: "fast",
      title: "Faster, on plates",
      flight: { ...PLATE, speed: "fastest" },
      view: { camera: "side", arrows: true },
      look: "curve",
      tell: ({ now, seen }) => [
        `${first(speed(now))}, on plates again, the bat needs ${watts(now.power)}.`,
        ...(seen.plate ? [`The frequency ${moved(seen.plate.frequency, now.frequency, hertz)}.`] : []),
      ],
    },
    {
      name: "fastFly",
      title: "Faster, with the fruit fly's wing",
      flight: { ...FLY, speed: "fastest" },
      speedOf: "fast",
      view: { camera: "side", arrows: true },
      pin: "fast",
      look: "curve",
      tell: ({ now, seen }) => [
        ...(seen.fast ? [`With the fruit fly's coefficients, power ${moved(seen.fast.power, now.power)} ${speed(now)}.`] : []),
        "Neither wing is a bat's. How far the two answers lie apart shows how much a result depends on that choice; it is no error bar.",
      ],
    },
  ],
};
