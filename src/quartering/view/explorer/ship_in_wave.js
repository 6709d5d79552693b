// The ship in its wave, moving: from aft and from above, to scale. Everything that moves is a column of samples of one round;
// the water is -a sin(k1 x - k2 y + omega t). Space plays and pauses, arrow keys step and change the pace.
const RATES = [0.5, 1, 2, 4, 8];
const BETWEEN_PICTURES = 1000 / 31;  // [ms]: a screen that shows 60 a second gets every other one

export default {
  template: `
    <div class="q-ship">
      <canvas ref="canvas" tabindex="0" role="img" :aria-label="label" @keydown="key"></canvas>
      <div class="q-ship-bar">
        <button type="button" class="q-ship-play" @click="toggle" :aria-label="playing ? 'pause' : 'play'">{{ playing ? '❚❚' : '▶' }}</button>
        <input type="range" min="0" :max="scene.time.length - 1" step="1" :value="at" aria-label="moment"
               :aria-valuetext="now" @input="seek">
        <label>pace <select :value="rate" @change="rate = Number($event.target.value)" aria-label="pace, times nature">
          <option v-for="one in rates" :key="one" :value="one">× {{ one }}</option></select></label>
        <span class="q-ship-now" aria-hidden="true">{{ now }}</span>
      </div>
    </div>`,
  props: { scene: Object, label: String },
  data() {
    return { playing: false, at: 0, rate: 4, rates: RATES };
  },
  computed: {
    now() {
      const s = this.scene, i = Math.min(this.at, s.time.length - 1), deg = 180 / Math.PI;
      return `${s.time[i].toFixed(1)} s, roll ${(s.roll[i] * deg).toFixed(1)}°, sway ${s.sway[i].toFixed(2)} m, yaw ${(s.yaw[i] * deg).toFixed(2)}°`;
    },
  },
  mounted() {
    this.watcher = new ResizeObserver(() => this.draw());
    this.watcher.observe(this.$refs.canvas);
    this.dark = new MutationObserver(() => this.draw());
    this.dark.observe(document.body, { attributes: true, attributeFilter: ["class"] });
    this.rate = RATES.reduce((b, one) => (Math.abs(one - this.scene.pace) < Math.abs(b - this.scene.pace) ? one : b), 1);
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.play();
    this.draw();
  },
  beforeUnmount() { this.watcher.disconnect(); this.dark.disconnect(); cancelAnimationFrame(this.asked); },
  watch: { scene() { this.at = Math.min(this.at, this.scene.time.length - 1); this.draw(); } },
  methods: {
    play() { this.playing = true; this.last = null; this.asked = requestAnimationFrame(this.step); },
    toggle() { if (this.playing) { this.playing = false; cancelAnimationFrame(this.asked); } else this.play(); },
    seek(event) { this.at = Number(event.target.value); this.left = 0; this.draw(); },
    step(now) {
      if (!this.playing) return;
      this.asked = requestAnimationFrame(this.step);
      if (this.last !== null && now - this.last < BETWEEN_PICTURES) return;
      const s = this.scene, dt = s.time[1] - s.time[0];
      this.left = (this.left || 0) + (this.last === null ? 0 : this.rate * Math.min(0.2, (now - this.last) / 1000) / dt);
      this.last = now;
      const whole = Math.floor(this.left);
      if (whole > 0) {
        this.left -= whole;
        this.at = (this.at + whole) % s.time.length;
        if (this.$refs.canvas.offsetParent !== null) this.draw();
      }
    },
    key(event) {
      const n = this.scene.time.length, i = RATES.indexOf(this.rate);
      if (event.key === " ") this.toggle();
      else if (event.key === "ArrowRight") { this.at = (this.at + 1) % n; this.draw(); }
      else if (event.key === "ArrowLeft") { this.at = (this.at + n - 1) % n; this.draw(); }
      else if (event.key === "ArrowUp") this.rate = RATES[Math.min(RATES.length - 1, i + 1)];
      else if (event.key === "ArrowDown") this.rate = RATES[Math.max(0, i - 1)];
      else return;
      event.preventDefault();
    },
    water(x, y) {
      const s = this.scene;
      return -s.amplitude * Math.sin(s.k1 * x - s.k2 * y + s.omega * s.time[this.at]);
    },
    draw() {
      const canvas = this.$refs.canvas;
      if (!canvas || !canvas.clientWidth) return;
      const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
      if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
        canvas.width = Math.round(w * ratio); canvas.height = Math.round(h * ratio);
      }
      const c = canvas.getContext("2d"), css = getComputedStyle(document.body), of = (name) => css.getPropertyValue(name).trim();
      c.setTransform(ratio, 0, 0, ratio, 0, 0);
      c.clearRect(0, 0, w, h);
      c.font = "12px sans-serif";
      const split = Math.round(0.6 * w);
      this.aft(c, 0, 0, split - 6, h, of);
      this.above(c, split + 6, 0, w - split - 6, h, of);
    },
    frame(c, x, y, w, h) { c.save(); c.beginPath(); c.rect(x, y, w, h); c.clip(); },
    path(c, points) { c.beginPath(); points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y))); },
    aft(c, x0, y0, w, h, of) {
      const s = this.scene, i = this.at, scale = Math.min(w / (1.9 * s.beam), h / (1.5 * s.tall));
      const X = (y) => x0 + w / 2 + scale * y, Y = (z) => y0 + 0.52 * h - scale * z;
      const [sin, cos] = [Math.sin(s.roll[i]), Math.cos(s.roll[i])];
      const turned = (points) => points.map(([y, z]) => [X(y * cos + z * sin + s.sway[i]), Y(-y * sin + z * cos + s.heave[i])]);
      this.frame(c, x0, y0, w, h);
      c.fillStyle = of("--paper"); c.fillRect(x0, y0, w, h);
      this.path(c, turned(s.sections[0])); c.closePath();
      c.fillStyle = "#d9d2c5"; c.fill(); c.strokeStyle = of("--ink"); c.lineWidth = 1.6; c.stroke();
      c.lineWidth = 0.7; c.strokeStyle = "#6b6b6b";
      for (const one of s.sections.slice(1)) { this.path(c, turned(one)); c.stroke(); }
      const surface = [];
      for (let k = 0; k <= 60; k++) { const y = (k / 60 - 0.5) * w / scale; surface.push([X(y), Y(s.water + this.water(0, y))]); }
      this.path(c, [...surface, [x0 + w, y0 + h], [x0, y0 + h]]); c.closePath();
      c.globalAlpha = 0.72; c.fillStyle = "#7fb2dc"; c.fill(); c.globalAlpha = 1;
      this.path(c, surface); c.strokeStyle = "#1f6fb2"; c.lineWidth = 1.6; c.stroke();
      c.beginPath(); c.arc(X(s.sway[i]), Y(s.heave[i]), 3, 0, 7); c.fillStyle = "#1b1f24"; c.fill();
      this.words(c, "from aft", x0 + 6, y0 + 15, of);
      this.bar(c, x0 + 8, y0 + h - 10, scale, of);
      c.restore();
    },
    above(c, x0, y0, w, h, of) {
      const s = this.scene, i = this.at, scale = Math.min(h / (1.5 * s.length), w / (1.0 * s.length));
      const X = (y) => x0 + w / 2 + scale * y, Y = (x) => y0 + h / 2 - scale * x;
      this.frame(c, x0, y0, w, h);
      const nx = 22, ny = 40, a = s.amplitude || 1;
      for (let p = 0; p < nx; p++) for (let q = 0; q < ny; q++) {
        const y = ((p + 0.5) / nx - 0.5) * w / scale, x = (0.5 - (q + 0.5) / ny) * h / scale, up = (this.water(x, y) / a + 1) / 2;
        c.fillStyle = `hsl(209 60% ${Math.round(34 + 52 * up)}%)`;
        c.fillRect(x0 + p * w / nx, y0 + q * h / ny, w / nx + 1, h / ny + 1);
      }
      const [sin, cos] = [Math.sin(s.yaw[i]), Math.cos(s.yaw[i])];
      const turned = (points) => points.map(([x, y]) => [X(x * sin + y * cos + s.sway[i]), Y(x * cos - y * sin)]);
      this.path(c, turned(s.deck)); c.closePath();
      c.fillStyle = "#d9d2c5"; c.fill(); c.strokeStyle = "#1b1f24"; c.lineWidth = 1.4; c.stroke();
      this.path(c, turned(s.waterline)); c.strokeStyle = "#6b6b6b"; c.lineWidth = 0.8; c.stroke();
      c.fillStyle = "#14161acc"; c.fillRect(x0 + 3, y0 + 3, 78, 17);
      c.fillStyle = "#ffffff"; c.fillText("from above", x0 + 7, y0 + 16);
      c.restore();
    },
    words(c, text, x, y, of) { c.fillStyle = of("--quiet"); c.fillText(text, x, y); },
    bar(c, x, y, scale, of) {  // a length of 5 or 10 m
      const long = scale * 10 > 120 ? 5 : 10;
      c.strokeStyle = of("--ink"); c.lineWidth = 2; c.beginPath(); c.moveTo(x, y); c.lineTo(x + long * scale, y); c.stroke();
      c.fillStyle = of("--ink"); c.fillText(`${long} m`, x + 4, y - 5);
    },
  },
};
