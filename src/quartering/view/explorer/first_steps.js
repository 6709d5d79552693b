// What am I looking at: three steps, shown at the first visit and whenever they are asked for; the browser remembers that they were seen.
const SEEN = "quartering-steps";

export default {
  template: `
    <section v-if="at >= 0" class="q-steps" aria-label="what am I looking at" @keydown.esc="close">
      <p ref="words" tabindex="-1"><b>{{ at + 1 }} of {{ steps.length }}: {{ steps[at].title }}.</b> {{ steps[at].words }}</p>
      <div><button v-if="at > 0" @click="go(at - 1)">Back</button>
        <button v-if="at + 1 < steps.length" @click="go(at + 1)">Next</button>
        <button @click="close">{{ at + 1 < steps.length ? 'Skip' : 'Done' }}</button></div>
    </section>`,
  props: { steps: Array },
  data() { return { at: -1 }; },
  mounted() {
    try { if (localStorage.getItem(SEEN) === null) this.show(0); } catch { /* a browser that remembers nothing is not asked each time */ }
  },
  unmounted() { this.mark(null); },
  methods: {
    mark(selector) {
      document.querySelectorAll(".looked-at").forEach((one) => one.classList.remove("looked-at"));
      if (selector) document.querySelectorAll(selector).forEach((one) => one.classList.add("looked-at"));
    },
    show(at) { this.at = at; this.mark(this.steps[at].selector); },
    go(at) { this.show(at); this.$nextTick(() => this.$refs.words.focus()); },
    begin() { this.go(0); },
    close() {
      this.at = -1;
      this.mark(null);
      try { localStorage.setItem(SEEN, "seen"); } catch { /* nothing to remember it with */ }
    },
  },
};
