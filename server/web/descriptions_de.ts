/** The descriptions of the schemas in German, by their English text. A text that several schemas have stands in shared.json. */
import contour from "./texts/descriptions/contour.json";
import fillFactor from "./texts/descriptions/fill_factor.json";
import job from "./texts/descriptions/job.json";
import motionLaw from "./texts/descriptions/motion_law.json";
import probePath from "./texts/descriptions/probe_path.json";
import shared from "./texts/descriptions/shared.json";
import winding from "./texts/descriptions/winding.json";

export const descriptions: Record<string, string> = { ...job, ...contour, ...fillFactor, ...motionLaw, ...probePath, ...winding, ...shared };
