/** Numbers of segments that panels drew in their last full drawing. Their sum stands in data-segments of the page, where tests read it. */
const drawn = new Map<string, number>();

/** Notes how many segments a panel has drawn. */
export function countSegments(panel: string, count: number): void {
  drawn.set(panel, count);
  let sum = 0;
  for (const each of drawn.values()) sum += each;
  document.documentElement.dataset.segments = String(sum);
}
