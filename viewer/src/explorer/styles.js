// The explorer's style sheets, one for each part of its page.

import curve from "./curve.css";
import face from "./face.css";
import gauges from "./gauges.css";
import ownData from "./own_data.css";
import page from "./page.css";
import tour from "./tour.css";

// What holds for the whole page comes first, so that its parts can differ from it.
export const styles = page + face + curve + gauges + ownData + tour;
