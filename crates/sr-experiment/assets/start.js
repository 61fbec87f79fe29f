// Everything begins here. What fails leaves its static part in place.

const start = async () => {
  startTheme();
  startTables();
  startPlots();
  const place = $("viewer");
  if (!place || typeof DecompressionStream === "undefined") return;
  const viewer = new Viewer(place, dataOf("data-views"));
  await viewer.start();
  $("stills").open = false;
  document.documentElement.dataset.ready = "";
};

start();
