// Runs through the time of the results: plays, pauses, repeats.

/** Speeds that are offered: so many simulated seconds per second. */
const SPEEDS = [1, 2, 5];
/** Runs that last longer or shorter than this are shown in about the last of these [s]. */
const COMFORTABLE = [3, 30, 8];

export const niceSpeed = (duration, isStatic) => {
  const [least, most, wanted] = COMFORTABLE;
  if (!isStatic && duration >= least && duration <= most) return 1;
  return nearest(duration / (isStatic ? 4 : wanted));
};

/** The number 1, 2 or 5 times a power of ten that is nearest. */
const nearest = (value) => {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  const choices = [...SPEEDS, 10].map((speed) => speed * power);
  return choices.reduce((best, speed) => (Math.abs(Math.log(speed / value)) < Math.abs(Math.log(best / value)) ? speed : best));
};

export class Player {
  constructor(changed) {
    this.changed = changed;
    this.time = 0;
    this.start = 0;
    this.end = 0;
    this.speed = 1;
    this.isPlaying = false;
    this.isLooping = true;
    this.before = null;
  }

  /** Takes other results; the time stays where it can. */
  load(start, end, isStatic, keeps) {
    [this.start, this.end] = [start, end];
    if (!keeps) this.speed = niceSpeed(end - start, isStatic);
    this.seek(keeps ? this.time : start);
  }

  get canPlay() {
    return this.end > this.start;
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.start), this.end);
    this.changed();
  }

  play(isWanted = !this.isPlaying) {
    this.isPlaying = isWanted && this.canPlay;
    if (this.isPlaying && this.time >= this.end) this.time = this.start;
    this.before = null;
    this.changed();
  }

  faster(up) {
    const grown = this.speed * (up ? 2.2 : 1 / 2.2);
    this.speed = nearest(grown);
    this.changed();
  }

  /** Goes on by what the clock has gone on since the last call. Whether the time has changed. */
  tick(now) {
    if (!this.isPlaying) return false;
    const elapsed = this.before === null ? 0 : Math.min((now - this.before) / 1000, 0.25);
    this.before = now;
    let time = this.time + this.speed * elapsed;
    if (time > this.end) {
      if (this.isLooping) {
        time = this.start + ((time - this.start) % (this.end - this.start));
      } else {
        time = this.end;
        this.isPlaying = false;
      }
    }
    this.time = time;
    return true;
  }
}
