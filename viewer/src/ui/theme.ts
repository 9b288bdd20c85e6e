// Dark or light: the system's theme, as long as the user has not chosen one.

export class Theme {
  private chosen = false;

  /** @param changed is called when the colours of the page have changed */
  constructor(private readonly changed: () => void) {
    const system = window.matchMedia("(prefers-color-scheme: dark)");
    this.set(system.matches);
    system.addEventListener("change", () => {
      if (this.chosen) return;
      this.set(system.matches);
      this.changed();
    });
  }

  get dark(): boolean {
    return document.documentElement.dataset["theme"] === "dark";
  }
  toggle(): void {
    this.chosen = true;
    this.set(!this.dark);
    this.changed();
  }
  private set(dark: boolean): void {
    document.documentElement.dataset["theme"] = dark ? "dark" : "light";
  }
}
