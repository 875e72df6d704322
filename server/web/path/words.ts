import { texts } from "../base/texts";
import de from "../texts/de/path.json";
import en from "../texts/en/path.json";

export const t = texts(en, de);
