// What the explorer takes from the viewer's bundle, which a page runs first.

export const { Viewer, Flight, setView, viewOf, make, draw, capital, short, ticks, mount } = globalThis.wingbeatViewer;
