(* The kernel's axioms (crates/kernel/src/axioms.txt) as theorems about Rocq's real and complex numbers, with a tactic for signs of
   closed terms and rules of differentiation. *)

Require Import Reals Lra Lia.
Require Import Coquelicot.Coquelicot.
Require Interval.Tactic.
Require Import Interval.Float.Specific_stdz Interval.Float.Specific_ops.
Open Scope R_scope.

(* The words of the table. *)

Definition integer (x : R) : Prop := exists z : Z, x = IZR z.

Definition root (n : nat) (x : R) : R :=
  match n with
  | 2%nat => sqrt x
  | _ =>
    if Rlt_dec 0 x then Rpower x (/ INR n)
    else if Rlt_dec x 0 then - Rpower (- x) (/ INR n)
    else 0
  end.

Definition rpow (x y : R) : R :=
  if Rlt_dec 0 x then Rpower x y
  else if Req_EM_T y (IZR (Int_part y)) then powerRZ x (Int_part y)
  else 0.

(* Powers by cases of their exponent and base. *)

Lemma Int_part_IZR : forall z : Z, Int_part (IZR z) = z.
Proof.
  intro z. destruct (base_Int_part (IZR z)) as [H1 H2].
  apply le_IZR in H1.
  assert (H3 : IZR (z - 1) < IZR (Int_part (IZR z))) by (rewrite minus_IZR; lra).
  apply lt_IZR in H3. lia.
Qed.

Lemma rpow_IZR : forall (x : R) (z : Z), rpow x (IZR z) = powerRZ x z.
Proof.
  intros x z. unfold rpow. rewrite Int_part_IZR.
  destruct (Rlt_dec 0 x) as [H | H].
  - now rewrite powerRZ_Rpower.
  - destruct (Req_EM_T (IZR z) (IZR z)) as [_ | F]; [reflexivity | now elim F].
Qed.

Lemma rpow_INR : forall (x : R) (n : nat), rpow x (INR n) = x ^ n.
Proof. intros x n. now rewrite INR_IZR_INZ, rpow_IZR, pow_powerRZ. Qed.

Lemma rpow_pos : forall x y : R, 0 < x -> rpow x y = exp (y * ln x).
Proof. intros x y H. unfold rpow. destruct (Rlt_dec 0 x); [reflexivity | contradiction]. Qed.

Lemma rpow_Rpower : forall x y : R, 0 < x -> rpow x y = Rpower x y.
Proof. exact rpow_pos. Qed.

Lemma powerRZ_nonneg_add : forall (x : R) (a b : Z), (0 <= a)%Z -> (0 <= b)%Z ->
  powerRZ x (a + b) = powerRZ x a * powerRZ x b.
Proof.
  intros x a b Ha Hb.
  rewrite <- (Z2Nat.id a Ha), <- (Z2Nat.id b Hb), <- Nat2Z.inj_add, <- !pow_powerRZ.
  apply pow_add.
Qed.

Lemma powerRZ_powerRZ : forall (x : R) (a b : Z), powerRZ (powerRZ x a) b = powerRZ x (a * b).
Proof.
  assert (N : forall (x : R) (n m : nat),
    powerRZ (powerRZ x (Z.of_nat n)) (Z.of_nat m) = powerRZ x (Z.of_nat n * Z.of_nat m)).
  { intros x n m. rewrite <- Nat2Z.inj_mul, <- !pow_powerRZ. symmetry. apply pow_mult. }
  intros x a b.
  destruct (Z_le_gt_dec 0 a) as [Ha | Ha]; destruct (Z_le_gt_dec 0 b) as [Hb | Hb].
  - rewrite <- (Z2Nat.id a Ha), <- (Z2Nat.id b Hb). apply N.
  - replace b with (- Z.of_nat (Z.to_nat (- b)))%Z by lia.
    rewrite <- (Z2Nat.id a Ha), Z.mul_opp_r, !powerRZ_neg', N. reflexivity.
  - replace a with (- Z.of_nat (Z.to_nat (- a)))%Z by lia.
    rewrite <- (Z2Nat.id b Hb), Z.mul_opp_l, !powerRZ_neg', powerRZ_inv', N. reflexivity.
  - replace a with (- Z.of_nat (Z.to_nat (- a)))%Z by lia.
    replace b with (- Z.of_nat (Z.to_nat (- b)))%Z by lia.
    rewrite Z.mul_opp_opp, !powerRZ_neg', powerRZ_inv', Rinv_inv, N. reflexivity.
Qed.

(* Roots by cases of their radicand. *)

Lemma INR_pos : forall n : nat, (1 <= n)%nat -> 0 < INR n.
Proof. intros n H. apply lt_0_INR. lia. Qed.

Lemma root_Rpower : forall (n : nat) (x : R), 0 < x -> root n x = Rpower x (/ INR n).
Proof.
  intros n x H.
  destruct n as [| [| [| n]]]; unfold root;
    try (destruct (Rlt_dec 0 x); [reflexivity | contradiction]).
  symmetry. replace (INR 2) with 2 by (simpl; ring). now apply Rpower_sqrt.
Qed.

Lemma root_pos : forall (n : nat) (x : R), 0 < x -> root n x = exp (ln x / INR n).
Proof.
  intros n x H. rewrite root_Rpower by assumption. unfold Rpower. f_equal.
  unfold Rdiv. ring.
Qed.

Lemma root_0 : forall n : nat, root n 0 = 0.
Proof.
  intros n. destruct n as [| [| [| n]]]; unfold root;
    try (destruct (Rlt_dec 0 0); [lra | reflexivity]).
  apply sqrt_0.
Qed.

Lemma root_zero : forall (n : nat) (x : R), x = 0 -> root n x = 0.
Proof. intros n x ->. apply root_0. Qed.

Lemma root_opp : forall (n : nat) (x : R), Nat.odd n = true -> x < 0 -> root n x = - root n (- x).
Proof.
  intros n x O H.
  destruct n as [| [| [| n]]]; unfold root; try discriminate O;
    (destruct (Rlt_dec 0 x); [lra |]; destruct (Rlt_dec x 0); [| lra];
     destruct (Rlt_dec 0 (- x)); [reflexivity | lra]).
Qed.

Lemma root_neg : forall (n : nat) (x : R), Nat.odd n = true -> x < 0 -> root n x = - exp (ln (- x) / INR n).
Proof. intros n x O H. rewrite root_opp by assumption. rewrite root_pos by lra. reflexivity. Qed.

Lemma root_gt_0 : forall (n : nat) (x : R), 0 < x -> 0 < root n x.
Proof. intros n x H. rewrite root_pos by assumption. apply exp_pos. Qed.

Lemma root_ge_0 : forall (n : nat) (x : R), 0 <= x -> 0 <= root n x.
Proof.
  intros n x [H | <-]; [left; now apply root_gt_0 | rewrite root_0; lra].
Qed.

Lemma root_pow : forall (n : nat) (x : R), (1 <= n)%nat -> 0 <= x -> root n x ^ n = x.
Proof.
  intros n x N [H | <-].
  - rewrite root_Rpower by assumption.
    rewrite <- Rpower_pow by apply exp_pos.
    rewrite Rpower_mult, Rinv_l; [now apply Rpower_1 |].
    apply Rgt_not_eq. now apply INR_pos.
  - rewrite root_0. apply pow_i. lia.
Qed.

Lemma pow_opp_odd : forall (n : nat) (x : R), Nat.odd n = true -> (- x) ^ n = - x ^ n.
Proof.
  intros n x O. apply Nat.odd_spec in O. destruct O as [k ->].
  rewrite !pow_add, !pow_mult. replace ((- x) ^ 2) with (x ^ 2) by ring. ring.
Qed.

Lemma pow_0_eq : forall (n : nat) (x : R), x ^ n = 0 -> x = 0.
Proof.
  intros n x H. destruct (Req_dec x 0) as [E | E]; [exact E | elim (pow_nonzero x n E H)].
Qed.

(* Sines and cosines. *)

Lemma Pythagoras : forall x : R, sin x ^ 2 + cos x ^ 2 = 1.
Proof. intro x. generalize (sin2_cos2 x). unfold Rsqr. intros. ring_simplify. lra. Qed.

Lemma SineOfSum : forall s a b : R, s = a + b -> sin s = sin a * cos b + cos a * sin b.
Proof. intros s a b ->. apply sin_plus. Qed.

Lemma CosineOfSum : forall s a b : R, s = a + b -> cos s = cos a * cos b - sin a * sin b.
Proof. intros s a b ->. apply cos_plus. Qed.

Lemma SineOfNegative : forall s a : R, s = - a -> sin s = - sin a.
Proof. intros s a ->. apply sin_neg. Qed.

Lemma CosineOfNegative : forall s a : R, s = - a -> cos s = cos a.
Proof. intros s a ->. apply cos_neg. Qed.

Lemma SineOfZero : forall s : R, s = 0 -> sin s = 0.
Proof. intros s ->. apply sin_0. Qed.

Lemma CosineOfZero : forall s : R, s = 0 -> cos s = 1.
Proof. intros s ->. apply cos_0. Qed.

Lemma SineOfPi : sin PI = 0.
Proof. exact sin_PI. Qed.

Lemma CosineOfPi : cos PI = -1.
Proof. exact cos_PI. Qed.

Lemma SineOfHalfTurns : forall n : R, integer n -> sin (PI * n) = 0.
Proof. intros n [z ->]. apply sin_eq_0_1. exists z. ring. Qed.

Lemma cos_PI_INR : forall n : nat, cos (PI * INR n) = (-1) ^ n.
Proof.
  induction n as [| n IH].
  - simpl. rewrite Rmult_0_r. apply cos_0.
  - rewrite S_INR, Rmult_plus_distr_l, Rmult_1_r, neg_cos, IH. simpl. ring.
Qed.

Lemma CosineOfHalfTurns : forall n : R, integer n -> cos (PI * n) = rpow (-1) n.
Proof.
  intros n [z ->]. rewrite rpow_IZR.
  destruct (Z_le_gt_dec 0 z) as [H | H].
  - rewrite <- (Z2Nat.id z H), <- INR_IZR_INZ, <- pow_powerRZ. apply cos_PI_INR.
  - replace z with (- Z.of_nat (Z.to_nat (- z)))%Z by lia.
    rewrite powerRZ_neg', opp_IZR, Ropp_mult_distr_r_reverse, cos_neg, <- INR_IZR_INZ, <- pow_powerRZ, cos_PI_INR.
    rewrite <- pow_inv. f_equal. lra.
Qed.

Lemma CosineOfTurns : forall n : R, integer n -> cos (2 * PI * n) = 1.
Proof.
  intros n I. replace (2 * PI * n) with (2 * (PI * n)) by ring.
  rewrite cos_2a_sin, SineOfHalfTurns by assumption. ring.
Qed.

Lemma SinePositive : forall x : R, x > 0 -> PI - x > 0 -> sin x > 0.
Proof. intros x H1 H2. apply sin_gt_0; lra. Qed.

Lemma AngleUnique : forall a b : R, sin a = sin b -> cos a = cos b ->
  2 * PI - (a - b) > 0 -> 2 * PI + (a - b) > 0 -> a = b.
Proof.
  intros a b S C H1 H2.
  assert (D : cos (a - b) = 1).
  { rewrite cos_minus, S, C. generalize (sin2_cos2 b). unfold Rsqr. lra. }
  assert (Z : sin ((a - b) / 2) = 0).
  { replace (a - b) with (2 * ((a - b) / 2)) in D by field. rewrite cos_2a_sin in D. nra. }
  destruct (Rtotal_order (a - b) 0) as [L | [E | G]].
  - generalize (sin_gt_0 (- ((a - b) / 2))). rewrite sin_neg. lra.
  - lra.
  - generalize (sin_gt_0 ((a - b) / 2)). lra.
Qed.

(* Exponential function and logarithm. *)

Lemma ExpOfSum : forall s a b : R, s = a + b -> exp s = exp a * exp b.
Proof. intros s a b ->. apply exp_plus. Qed.

Lemma ExpOfZero : forall s : R, s = 0 -> exp s = 1.
Proof. intros s ->. apply exp_0. Qed.

Lemma ExpPositive : forall x : R, exp x > 0.
Proof. exact exp_pos. Qed.

Lemma ExpNonzero : forall x : R, exp x <> 0.
Proof. intro x. apply Rgt_not_eq, exp_pos. Qed.

Lemma ExpInjective : forall a b : R, exp a = exp b -> a = b.
Proof. exact exp_inv. Qed.

Lemma ExpOfLn : forall x : R, x > 0 -> exp (ln x) = x.
Proof. exact exp_ln. Qed.

Lemma LnOfExp : forall x : R, ln (exp x) = x.
Proof. exact ln_exp. Qed.

(* Roots. *)

Lemma RootPower : forall (n : nat) (x : R), (2 <= n)%nat -> (Nat.even n = true -> x >= 0) -> root n x ^ n = x.
Proof.
  intros n x N E. destruct (Rle_dec 0 x) as [H | H].
  - apply root_pow; [lia | exact H].
  - assert (O : Nat.odd n = true).
    { rewrite <- Nat.negb_even. destruct (Nat.even n); [| reflexivity]. specialize (E eq_refl). lra. }
    rewrite root_opp, pow_opp_odd, root_pow; try assumption; try lra. lia.
Qed.

Lemma RootNonNegative : forall (n : nat) (x : R), (2 <= n)%nat -> Nat.even n = true ->
  (Nat.even n = true -> x >= 0) -> root n x >= 0.
Proof. intros n x _ E H. apply Rle_ge, root_ge_0, Rge_le, H, E. Qed.

Lemma RootUnique : forall (n : nat) (x y : R), (2 <= n)%nat -> y >= 0 -> y ^ n = x -> root n x = y.
Proof.
  intros n x y N Y <-. destruct Y as [Y | ->].
  - rewrite root_Rpower by now apply pow_lt.
    rewrite <- Rpower_pow, Rpower_mult, Rinv_r; [now apply Rpower_1 | | assumption].
    apply Rgt_not_eq, INR_pos. lia.
  - rewrite pow_i by lia. apply root_0.
Qed.

Lemma OddRootUnique : forall (n : nat) (x y : R), (2 <= n)%nat -> Nat.odd n = true -> y ^ n = x -> root n x = y.
Proof.
  intros n x y N O E. destruct (Rle_dec 0 y) as [H | H].
  - apply RootUnique; [exact N | lra | exact E].
  - assert (P : 0 < (- y) ^ n) by (apply pow_lt; lra).
    rewrite pow_opp_odd, E in P by assumption.
    rewrite root_opp, (RootUnique n (- x) (- y)); try assumption; try lra.
    rewrite pow_opp_odd by assumption. lra.
Qed.

(* Powers. *)

Lemma RealPower : forall x y : R, x > 0 -> rpow x y = exp (y * ln x).
Proof. exact rpow_pos. Qed.

Lemma IntegerPower : forall (x p : R) (n : nat), p = INR n -> rpow x p = x ^ n.
Proof. intros x p n ->. apply rpow_INR. Qed.

Lemma NegativePower : forall (x p : R) (n : nat), p = - INR n -> x <> 0 -> rpow x p = 1 / x ^ n.
Proof.
  intros x p n -> X. rewrite INR_IZR_INZ, <- opp_IZR, rpow_IZR, powerRZ_neg', <- pow_powerRZ.
  unfold Rdiv. ring.
Qed.

Lemma PowerOfSum : forall x s a b : R, s = a + b -> integer a -> integer b -> a >= 0 -> b >= 0 ->
  rpow x s = rpow x a * rpow x b.
Proof.
  intros x s a b -> [n ->] [m ->] N M. rewrite <- plus_IZR, !rpow_IZR.
  apply powerRZ_nonneg_add; apply le_IZR; lra.
Qed.

Lemma NonzeroPowerOfSum : forall x s a b : R, s = a + b -> integer a -> integer b -> x <> 0 ->
  rpow x s = rpow x a * rpow x b.
Proof.
  intros x s a b -> [n ->] [m ->] X. rewrite <- plus_IZR, !rpow_IZR. now apply powerRZ_add.
Qed.

Lemma PowerOfProduct : forall p a b n : R, p = a * b -> integer n -> n >= 0 -> rpow p n = rpow a n * rpow b n.
Proof. intros p a b n -> [z ->] _. rewrite !rpow_IZR. apply powerRZ_mult. Qed.

Lemma NonzeroPowerOfProduct : forall p a b n : R, p = a * b -> integer n -> a <> 0 -> b <> 0 ->
  rpow p n = rpow a n * rpow b n.
Proof. intros p a b n -> [z ->] _ _. rewrite !rpow_IZR. apply powerRZ_mult. Qed.

Lemma PowerOfPower : forall x p n m : R, p = n * m -> integer n -> integer m -> x <> 0 ->
  rpow (rpow x n) m = rpow x p.
Proof.
  intros x p n m -> [a ->] [b ->] _. rewrite <- mult_IZR, !rpow_IZR. apply powerRZ_powerRZ.
Qed.

Lemma PowerNonzero : forall x n : R, x <> 0 -> integer n -> rpow x n <> 0.
Proof. intros x n X [z ->]. rewrite rpow_IZR. now apply powerRZ_NOR. Qed.

Lemma PowerOfOne : forall x y : R, x = 1 -> rpow x y = 1.
Proof. intros x y ->. rewrite rpow_pos by lra. rewrite ln_1, Rmult_0_r. apply exp_0. Qed.

Lemma IntegerAtLeastOne : forall n : R, integer n -> n > 0 -> n >= 1.
Proof. intros n [z ->] H. apply lt_IZR in H. apply IZR_ge. lia. Qed.

(* Inverse functions of sines, cosines and tangents. *)

Lemma SineOfArcsin : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> sin (asin x) = x.
Proof. intros x H1 H2. apply sin_asin. lra. Qed.

Lemma CosineOfArccos : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> cos (acos x) = x.
Proof. intros x H1 H2. apply cos_acos. lra. Qed.

Lemma CosineOfArctan : forall x : R, cos (atan x) > 0.
Proof. intro x. destruct (atan_bound x) as [H1 H2]. apply cos_gt_0; lra. Qed.

Lemma SineOfArctan : forall x : R, sin (atan x) = x * cos (atan x).
Proof.
  intro x. generalize (CosineOfArctan x). intro C.
  rewrite <- (tan_atan x) at 2. unfold tan. field. lra.
Qed.

Lemma CosineOfArcsin : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> cos (asin x) >= 0.
Proof. intros x _ _. destruct (asin_bound x) as [H1 H2]. apply Rle_ge, cos_ge_0; lra. Qed.

Lemma SineOfArccos : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> sin (acos x) >= 0.
Proof. intros x _ _. destruct (acos_bound x) as [H1 H2]. apply Rle_ge, sin_ge_0; lra. Qed.

Lemma ArcsinAbove : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> asin x + PI / 2 >= 0.
Proof. intros x _ _. destruct (asin_bound x). lra. Qed.

Lemma ArcsinBelow : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> PI / 2 - asin x >= 0.
Proof. intros x _ _. destruct (asin_bound x). lra. Qed.

Lemma ArccosAbove : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> acos x >= 0.
Proof. intros x _ _. destruct (acos_bound x). lra. Qed.

Lemma ArccosBelow : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> PI - acos x >= 0.
Proof. intros x _ _. destruct (acos_bound x). lra. Qed.

Lemma ArctanOfZero : forall x : R, x = 0 -> atan x = 0.
Proof. intros x ->. exact atan_0. Qed.

Lemma ArctanAbove : forall x : R, atan x + PI / 2 > 0.
Proof. intro x. destruct (atan_bound x). lra. Qed.

Lemma ArctanBelow : forall x : R, PI / 2 - atan x > 0.
Proof. intro x. destruct (atan_bound x). lra. Qed.
