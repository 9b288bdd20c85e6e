// /SENSOR (deck-format.md D.10). Only TIME has a meaning here; a sensor of another kind is refused where something refers to it.
#include "model/condition_fields.hpp"

namespace abut::model {

void read_sensors(Context& c) {
  std::vector<Sensor>& sensors = c.model->sensors;
  for (const deck::Block& block : c.deck->blocks) {
    if (!is_keyword(block, "SENSOR", "TIME")) continue;
    BlockReader r(c, block, 2, true);
    Sensor s;
    s.id = r.id();
    r.next_card();
    s.t_on = r.real({1, 20}, "Tdelay", dim::time);
    if (s.t_on < 0.0) r.error("model.out_of_range", {1, 20}, "Tdelay", "a delay cannot be negative; write 0 or more");
    r.next_card();
    s.t_off = stop_time(r, {1, 20}, "Tstop");
    if (s.t_off <= s.t_on) r.error("model.out_of_range", {1, 20}, "Tstop", "Tstop must be later than Tdelay, or 0 for never");
    sensors.push_back(s);
  }
  order_by_id(c, sensors, "SENSOR", false);
  fill_table(c.tables.sensors, sensors);
}

}  // namespace abut::model
