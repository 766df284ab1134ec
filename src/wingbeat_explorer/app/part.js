// A part of the page that is drawn anew by itself: what changes inside leaves all other elements alone. Without parts,
// one changed word would have a thousand elements drawn anew.
export default {
  props: { as: String },
  template: `<component :is="as"><slot></slot></component>`,
};
