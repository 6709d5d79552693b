// The hull in three dimensions: its surface as shaded facets, the far ones first. Drag or arrow keys turn it.
const VIEWS = { "quarter": [-2.3, 0.45], "side": [-Math.PI / 2, 0.05], "bow": [0, 0.1], "aft": [Math.PI, 0.1], "above": [-Math.PI / 2, 1.5], "below": [-Math.PI / 2, -1.2] };

export default {
  template: `
    <div class="q-hull-form">
      <canvas ref="canvas" tabindex="0" role="img" :aria-label="label" @keydown="key" @pointerdown="grab" @pointermove="drag"
              @pointerup="held = null" @pointercancel="held = null"></canvas>
      <div class="q-ship-bar" role="group" aria-label="seen from">
        <button v-for="(view, name) in views" :key="name" type="button" @click="look(view)">{{ name }}</button>
      </div>
    </div>`,
  props: { surface: Array, water: Number, label: String },
  data() { return { turn: VIEWS.quarter[0], lift: VIEWS.quarter[1], held: null, views: VIEWS }; },
  mounted() {
    this.watcher = new ResizeObserver(() => this.draw());
    this.watcher.observe(this.$refs.canvas);
    this.dark = new MutationObserver(() => this.draw());
    this.dark.observe(document.body, { attributes: true, attributeFilter: ["class"] });
    this.draw();
  },
  beforeUnmount() { this.watcher.disconnect(); this.dark.disconnect(); },
  watch: { surface() { this.draw(); } },
  methods: {
    look([turn, lift]) { this.turn = turn; this.lift = lift; this.draw(); },
    grab(event) { this.held = [event.clientX, event.clientY]; event.target.setPointerCapture(event.pointerId); },
    drag(event) {
      if (!this.held) return;
      this.turn -= 0.008 * (event.clientX - this.held[0]); this.lift += 0.008 * (event.clientY - this.held[1]);
      this.held = [event.clientX, event.clientY];
      this.draw();
    },
    key(event) {
      const step = { ArrowLeft: [0.12, 0], ArrowRight: [-0.12, 0], ArrowUp: [0, 0.12], ArrowDown: [0, -0.12] }[event.key];
      if (!step) return;
      event.preventDefault();
      this.turn += step[0]; this.lift += step[1];
      this.draw();
    },
    facets() {  // both sides, and the deck
      const s = this.surface, made = [], flip = ([x, y, z]) => [x, -y, z];
      for (let i = 0; i + 1 < s.length; i++) {
        for (let j = 0; j + 1 < s[i].length; j++) {
          const quad = [s[i][j], s[i + 1][j], s[i + 1][j + 1], s[i][j + 1]];
          made.push(quad, quad.map(flip));
        }
        const [a, b] = [s[i].at(-1), s[i + 1].at(-1)];
        made.push([a, b, flip(b), flip(a)]);
      }
      for (const end of [s[0], s.at(-1)]) made.push([...end, ...end.map(flip).reverse()]);
      return made;
    },
    draw() {
      this.lift = Math.max(-1.55, Math.min(1.55, this.lift));
      const canvas = this.$refs.canvas;
      if (!canvas || !canvas.clientWidth) return;
      const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
      canvas.width = Math.round(w * ratio); canvas.height = Math.round(h * ratio);
      const c = canvas.getContext("2d");
      c.setTransform(ratio, 0, 0, ratio, 0, 0);
      const all = this.surface.flat(), low = [0, 1, 2].map((k) => Math.min(...all.map((p) => p[k])));
      const high = [0, 1, 2].map((k) => Math.max(...all.map((p) => p[k])));
      const mid = [(low[0] + high[0]) / 2, 0, (low[2] + high[2]) / 2], reach = high[0] - low[0];
      const [ct, st, cl, sl] = [Math.cos(this.turn), Math.sin(this.turn), Math.cos(this.lift), Math.sin(this.lift)];
      // To the viewer's axes: right, up, towards the eye, which stands at (turn, lift) and looks at the middle.
      const seen = ([x, y, z]) => {
        const [a, b, d] = [x - mid[0], y - mid[1], z - mid[2]], near = a * ct - b * st, right = -a * st - b * ct;
        return [right, d * cl - near * sl, near * cl + d * sl];
      };
      const tall = Math.abs(sl) * 0.25 + 0.12, wide = Math.max(0.25, Math.abs(st) + 0.15 * Math.abs(ct));
      const scale = Math.min(0.94 * w / (reach * wide), 0.9 * h / (reach * (tall + 0.3 * Math.abs(sl * ct))));
      const drawn = this.facets().map((points) => {
        const eye = points.map(seen), [p, q, r] = [eye[0], eye[1], eye[Math.min(2, eye.length - 1)]];
        const u = [q[0] - p[0], q[1] - p[1], q[2] - p[2]], v = [r[0] - p[0], r[1] - p[1], r[2] - p[2]];
        const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], size = Math.hypot(...n) || 1;
        const light = Math.abs(0.35 * n[0] + 0.55 * n[1] + 0.76 * n[2]) / size;
        const wet = points.reduce((sum, one) => sum + one[2], 0) / points.length < this.water;
        return { eye, far: eye.reduce((sum, one) => sum + one[2], 0) / eye.length, light, wet };
      }).sort((a, b) => a.far - b.far);
      for (const one of drawn) {
        c.beginPath();
        one.eye.forEach(([x, y], i) => (i ? c.lineTo(w / 2 + scale * x, h / 2 - scale * y) : c.moveTo(w / 2 + scale * x, h / 2 - scale * y)));
        c.closePath();
        c.fillStyle = one.wet ? `hsl(209 45% ${Math.round(24 + 42 * one.light)}%)` : `hsl(38 22% ${Math.round(38 + 46 * one.light)}%)`;
        c.strokeStyle = c.fillStyle; c.lineWidth = 0.6;
        c.fill(); c.stroke();
      }
    },
  },
};
