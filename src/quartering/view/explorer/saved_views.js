// Named views, kept by this browser alone: a name and the link that gives the view again.
const PLACE = "quartering-views", MOST = 50, LONGEST = 60;

export default {
  template: `
    <div class="q-views">
      <form @submit.prevent="save">
        <label for="view-name">Name of the view shown now</label>
        <div><input id="view-name" ref="name" v-model="name" :maxlength="longest" autocomplete="off" />
          <button type="submit">Save</button></div>
      </form>
      <p class="q-views-told" role="status">{{ told }}</p>
      <ul v-if="views.length" aria-label="saved views">
        <li v-for="(view, i) in views" :key="view.name">
          <button class="q-views-open" ref="rows" @click="$emit('open', view.link)">{{ view.name }}</button>
          <span v-if="view.version !== version" class="q-views-old">of version {{ view.version || 'unknown' }}</span>
          <button class="q-views-delete" :aria-label="'delete ' + view.name" @click="remove(i)">✕</button>
        </li>
      </ul>
      <p v-else>No view is saved in this browser yet. It keeps them itself; the server knows none.</p>
    </div>`,
  props: { version: String },
  data() { return { views: [], name: "", told: "", longest: LONGEST }; },
  mounted() { this.views = this.read(); this.$refs.name.focus(); },
  methods: {
    read() {
      let kept;
      try { kept = localStorage.getItem(PLACE); } catch { this.told = "This browser keeps nothing for pages: use Copy link."; }
      if (!kept) return [];
      const sound = (view) => view && typeof view.name === "string" && typeof view.link === "string" && view.link.startsWith("?");
      try {
        const all = JSON.parse(kept), views = all.filter(sound);
        if (views.length < all.length) this.told = `${all.length - views.length} saved views cannot be read and are left out.`;
        return views;
      } catch { this.told = "What was saved here cannot be read; the next view that is saved takes its place."; return []; }
    },
    write(views, told) {
      try { localStorage.setItem(PLACE, JSON.stringify(views)); }
      catch { this.told = "This browser keeps nothing (more) for pages: use Copy link."; return; }
      this.views = views;
      this.told = told;
    },
    save() {
      const name = this.name.trim().slice(0, LONGEST);
      if (!name) { this.told = "Give the view a name first."; this.$refs.name.focus(); return; }
      const others = this.views.filter((view) => view.name !== name), again = others.length < this.views.length;
      if (others.length >= MOST) { this.told = `${MOST} views are saved; delete one first.`; return; }
      this.write([{ name, link: location.search, version: this.version }, ...others],
        again ? `“${name}” is saved anew in place of the one of that name.` : `“${name}” is saved.`);
      this.name = "";
    },
    remove(i) {
      const { name } = this.views[i];
      this.write(this.views.filter((_, k) => k !== i), `“${name}” is deleted.`);
      this.$nextTick(() => ((this.$refs.rows || [])[Math.min(i, this.views.length - 1)] || this.$refs.name).focus());
    },
  },
};
