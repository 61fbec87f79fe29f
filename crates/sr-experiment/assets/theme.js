// Dark, light, or what the system has; the choice is kept where the browser lets pages keep anything.

const THEMES = ["auto", "dark", "light"];

const startTheme = () => {
  const root = document.documentElement;
  const stored = () => {
    try {
      return localStorage.getItem("steradian-theme");
    } catch {
      return null;
    }
  };
  const toggle = button("", () => set(THEMES[(THEMES.indexOf(theme()) + 1) % THEMES.length]), {
    id: "theme",
  });
  const theme = () => root.dataset.theme ?? "auto";
  const set = (name) => {
    root.dataset.theme = name;
    toggle.textContent = { auto: "◐ auto", dark: "● dark", light: "○ light" }[name];
    toggle.title = "Colours: as the system has them, dark, or light";
    try {
      localStorage.setItem("steradian-theme", name);
    } catch {
      // A page without storage forgets.
    }
    document.dispatchEvent(new Event("themechange"));
  };
  const first = stored();
  set(THEMES.includes(first) ? first : "auto");
  document.querySelector("header").append(toggle);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => set(theme()));
  // On paper nothing can be opened.
  addEventListener("beforeprint", () => {
    for (const details of document.querySelectorAll("details:not([open])")) {
      details.dataset.closed = "";
      details.open = true;
    }
  });
  addEventListener("afterprint", () => {
    for (const details of document.querySelectorAll("details[data-closed]")) {
      delete details.dataset.closed;
      details.open = false;
    }
  });
};
