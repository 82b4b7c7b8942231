// Times as people read them.

/** `1:23`, or `2:19:58` from an hour on. */
export function clock(seconds: number): string {
  const whole = Math.round(seconds);
  const two = (value: number) => String(value).padStart(2, "0");
  const minutes = `${Math.floor(whole / 60) % 60}`;
  const hours = Math.floor(whole / 3600);
  return hours > 0 ? `${hours}:${minutes.padStart(2, "0")}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}
