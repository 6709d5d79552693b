// The polar map: a wedge for each heading and wave length, mirrored to the other side. Colours, patterns and the chosen
// place come from the server; a click, or an arrow key, sends the index of a heading and of a wave length back.
const SVG = "http://www.w3.org/2000/svg";
const R = 100, HOLE = 0.12;
let maps = 0;

export default {
  template: `
    <div class="q-map">
      <svg ref="svg" viewBox="-128 -121 256 242" tabindex="0" role="application" :aria-label="label"
           @keydown="key" @click="click" @mousemove="hover" @mouseleave="told = ''"></svg>
      <div class="q-map-told" aria-hidden="true">{{ told || 'cell ' + words(at) }}</div>
    </div>`,
  props: {
    headings: Array, radii: Array, roll: Array, kind: Array, kinds: Object, top: Number,
    chosen: Array, lines: Array, palette: Array, label: String, hatched: Array, dotted: Array, crossed: Array, also: Object,
    rings: { type: Array, default: () => [[0.5, "0.5 L"], [1, "λ = L"], [1.5, "1.5 L"], [2, "2 L"]] },  // radius, its label
    rows: { type: Array, default: null },  // words of each radius; by default wave lengths over L
    size: { type: String, default: "roll" },
  },
  data() { return { told: "" }; },
  computed: {
    at() {
      const near = (values, one) => values.reduce((b, v, i) => (Math.abs(v - one) < Math.abs(values[b] - one) ? i : b), 0);
      return [near(this.headings, this.chosen[0]), near(this.radii, this.chosen[1])];
    },
  },
  mounted() { this.uid = `m${maps++}`; this.build(); this.paint(); this.mark(); this.draw(); this.cross(); },
  watch: {
    roll() { this.paint(); }, kind() { this.paint(); }, top() { this.paint(); }, crossed() { this.cross(); }, also() { this.cross(); },
    chosen() { this.mark(); }, lines() { this.draw(); }, rings() { this.ring(); },
  },
  methods: {
    make(parent, name, attributes, text) {
      const made = document.createElementNS(SVG, name);
      for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
      if (text !== undefined) made.textContent = text;
      parent.appendChild(made);
      return made;
    },
    radius(ratio) { return R * (HOLE + (1 - HOLE) * ratio / this.outer); },
    place(mu, ratio, side) {  // following seas below, head seas on top, waves from port on the left
      const a = mu * Math.PI / 180, r = this.radius(ratio);
      return [-side * r * Math.sin(a), r * Math.cos(a)];
    },
    edges(values, low, high) {
      const inner = values.slice(1).map((v, i) => 0.5 * (v + values[i]));
      const first = values[0] - 0.5 * (values[1] - values[0]), last = values.at(-1) + 0.5 * (values.at(-1) - values.at(-2));
      return [Math.max(low, first), ...inner, Math.min(high, last)];
    },
    build() {
      const svg = this.$refs.svg, d = this.make(svg, "defs", {});
      for (const [name, w, shape] of [
        ["hatch", 3, (p) => { this.make(p, "rect", { width: 1, height: 3, class: "q-dark" });
                              this.make(p, "rect", { x: 1, width: 0.8, height: 3, class: "q-light" }); }],
        ["dots", 3.2, (p) => { this.make(p, "circle", { cx: 1.6, cy: 1.6, r: 0.8, class: "q-dark" });
                               this.make(p, "circle", { cx: 1.6, cy: 1.6, r: 0.5, class: "q-light" }); }],
      ]) shape(this.make(d, "pattern", { id: `${this.uid}-${name}`, width: w, height: w, patternUnits: "userSpaceOnUse",
                                         patternTransform: "rotate(45)" }));
      const mu = this.edges(this.headings, 0, 180), rim = this.edges(this.radii, 0, 1e9);
      this.outer = rim.at(-1);
      this.cells = []; this.marks = [];
      const fills = this.make(svg, "g", {}), overs = this.make(svg, "g", { "pointer-events": "none" });
      for (let i = 0; i < this.headings.length; i++) for (let j = 0; j < this.radii.length; j++) {
        let path = "";
        for (const side of [1, -1]) {
          const p = [[mu[i], rim[j]], [mu[i], rim[j + 1]], [mu[i + 1], rim[j + 1]], [mu[i + 1], rim[j]]]
            .map(([m, q]) => this.place(m, q, side).map((x) => x.toFixed(2)));
          const turn = side > 0 ? 1 : 0, out = this.radius(rim[j + 1]), inn = this.radius(rim[j]);
          path += `M${p[0]}L${p[1]}A${out},${out} 0 0 ${turn} ${p[2]}L${p[3]}A${inn},${inn} 0 0 ${1 - turn} ${p[0]}Z`;
        }
        this.cells.push(this.make(fills, "path", { d: path, "data-i": i, "data-j": j }));
        this.marks.push(this.make(overs, "path", { d: path, fill: "none" }));
      }
      this.curves = this.make(svg, "g", { "pointer-events": "none" });  // under the rings' labels
      this.crosses = this.make(svg, "g", { "pointer-events": "none" });
      const frame = this.make(svg, "g", { class: "q-frame", "pointer-events": "none" });
      for (let angle = 0; angle < 360; angle += 30) {
        const side = angle > 180 ? -1 : 1, m = angle > 180 ? 360 - angle : angle;
        const a = m * Math.PI / 180, x = -side * Math.sin(a), y = Math.cos(a);
        const text = m === 0 ? "0° following" : m === 180 ? "180° head" : `${m}°`;
        this.make(frame, "line", { x1: x * R * HOLE, y1: y * R * HOLE, x2: x * R, y2: y * R });
        this.make(frame, "text", { x: x * 107, y: y * (m % 180 ? 107 : 109) + 2.2,
          "text-anchor": m % 180 === 0 ? "middle" : x < 0 ? "end" : "start" }, text);
      }
      this.ringed = this.make(frame, "g", {});
      this.ring();
      this.make(frame, "path", { class: "q-hull", d: "M0,-11L2.2,-6L2.6,-2L2.6,8L1.8,10.5L-1.8,10.5L-2.6,8L-2.6,-2L-2.2,-6Z" });
      this.pointer = this.make(svg, "g", { class: "q-chosen", "pointer-events": "none" });
    },
    ring() {
      this.ringed.replaceChildren();
      for (const [ratio, text] of this.rings.filter(([q]) => q < this.outer)) {
        const r = this.radius(ratio);
        this.make(this.ringed, "circle", { r, fill: "none" });
        this.make(this.ringed, "text", { x: 1.5, y: -r + 4.6, class: "q-ring" }, text);
      }
    },
    paint() {
      const n = this.palette.length - 1;
      this.cells.forEach((cell, k) => {
        const roll = this.roll[k], kind = this.kind[k], code = String(kind);
        const known = roll !== null && roll !== undefined;
        const colour = known ? this.palette[Math.min(n, Math.round(n * roll / this.top))] : "";
        for (const name of ["fill", "stroke"]) cell.setAttribute(name, colour);  // the stroke hides the seams
        cell.setAttribute("class", known ? "q-cell" : kind === null ? "q-cell q-awaited" : "q-cell q-none");
        const over = this.hatched.includes(kind) ? "hatch" : this.dotted.includes(kind) ? "dots" : "";
        this.marks[k].setAttribute("fill", over ? `url(#${this.uid}-${over})` : "none");
        cell.dataset.kind = code;
      });
    },
    mark() {
      this.pointer.replaceChildren();
      for (const side of [1, -1]) {
        const [x, y] = this.place(this.chosen[0], Math.min(this.chosen[1], this.outer), side);
        if (side < 0 && Math.abs(x) < 1) continue;
        this.make(this.pointer, "circle", { cx: x, cy: y, r: 4.2, class: side > 0 ? "q-halo" : "q-halo q-mirror" });
        this.make(this.pointer, "circle", { cx: x, cy: y, r: 4.2, class: side > 0 ? "q-dot" : "q-dot q-mirror" });
      }
    },
    cross() {  // rings: other stable motions; crosses: stable motions that the ship capsizes before
      this.crosses.replaceChildren();
      for (const k of Object.keys(this.also || {})) for (const side of [1, -1]) {
        const [x, y] = this.place(this.headings[Math.floor(k / this.radii.length)], this.radii[k % this.radii.length], side);
        if (side < 0 && Math.abs(x) < 1e-6) continue;
        for (const name of ["q-cross-back", "q-also"]) this.make(this.crosses, "circle", { cx: x, cy: y, r: 1.5, class: name });
      }
      for (const k of this.crossed || []) for (const side of [1, -1]) {
        const [x, y] = this.place(this.headings[Math.floor(k / this.radii.length)], this.radii[k % this.radii.length], side);
        if (side < 0 && Math.abs(x) < 1e-6) continue;
        const d = `M${x - 1.3},${y - 1.3}l2.6,2.6m-2.6,0l2.6,-2.6`;
        for (const name of ["q-cross-back", "q-cross"]) this.make(this.crosses, "path", { d, class: name });
      }
    },
    draw() {
      this.curves.replaceChildren();
      for (const line of this.lines) for (const side of [1, -1]) {
        const d = line.points.map((piece) => "M" + piece.map(([m, q]) =>
          this.place(m, q, side).map((x) => x.toFixed(2))).join("L")).join("");
        this.make(this.curves, "path", { d, class: "q-line-back" });
        this.make(this.curves, "path", { d, class: "q-line", "stroke-dasharray": line.dash });
      }
    },
    cell(event) {
      const at = event.target.dataset;
      return at && at.i !== undefined ? [Number(at.i), Number(at.j)] : null;
    },
    words([i, j]) {
      const k = i * this.radii.length + j, roll = this.roll[k], kind = this.kinds[String(this.kind[k])] || "not yet computed";
      const size = roll === null || roll === undefined ? "" : `${this.size} ${roll.toFixed(1)}°, `;
      const way = (this.crossed || []).includes(k) ? ", capsizes on the way" : "";
      const other = (this.also || {})[k] === undefined ? "" : `, also ${this.also[k].toFixed(1)}°`;
      const row = this.rows ? this.rows[j] : `λ = ${this.radii[j].toFixed(1)} L`;
      return `${this.headings[i]}°, ${row}: ${size}${kind}${way}${other}`;
    },
    hover(event) { const at = this.cell(event); this.told = at ? 'cell ' + this.words(at) : ""; },
    choose(i, j) {
      if (i < 0 || j < 0 || i >= this.headings.length || j >= this.radii.length) return;
      this.told = "";
      this.$emit("choose", { heading: i, length: j });
    },
    click(event) { const at = this.cell(event); if (at) this.choose(...at); },
    key(event) {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!step) return;
      event.preventDefault();
      this.choose(this.at[0] + step[0], this.at[1] + step[1]);
    },
  },
};
