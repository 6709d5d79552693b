// What the page does by itself: the link follows what is shown, Back brings the last view again, figures fit their panel.
(() => {
  document.documentElement.lang = "en";
  const PAUSE = 1200;  // one turn of a dial is one step back, however many values it passed [ms]
  let last = -1e9, returning = "", backs = 0;
  window.quarteringLink = (link, first, after) => {
    if (after !== String(backs)) return;  // of a view that was left by going back before it came
    const now = performance.now(), same = location.search === link;
    if (!same && !first && returning !== link && now - last > PAUSE) history.pushState({}, "", link);
    else if (!same) history.replaceState({}, "", link);
    if (!same && !first) last = now;  // the view a page opens with is a step of its own, however soon it is left
    returning = "";
  };
  window.addEventListener("popstate", () => {
    returning = location.search;
    last = -1e9;
    backs += 1;
    emitEvent("quartering-back", `${backs} ${location.search}`);
  });
  import("nicegui-plotly").then(({ Plotly }) => {
    const fit = () => document.querySelectorAll(".panel .js-plotly-plot").forEach((plot) => {
      if (plot.offsetParent !== null && plot._fullLayout) Plotly.Plots.resize(plot);
    });
    const panel = document.querySelector(".panel");
    if (panel) new ResizeObserver(fit).observe(panel);
  });
})();
